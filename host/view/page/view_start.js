// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// This begins `weft view`'s page, once all of its files are there: it listens, and connects.

'use strict';

function listenToView() {
    viewArea.addEventListener('pointerdown', onPointerDown);
    viewArea.addEventListener('pointermove', onPointerMove);
    viewArea.addEventListener('pointerup', onPointerEnd);
    viewArea.addEventListener('pointercancel', onPointerEnd);
    viewArea.addEventListener('wheel', onWheel, { passive: false });
    viewArea.addEventListener('contextmenu', (event) => event.preventDefault());
    window.addEventListener('keydown', onKeyDown);
    window.addEventListener('keyup', onKeyUp);
    window.addEventListener('blur', releaseKeys);
    window.addEventListener('hashchange', reconnect);
    new ResizeObserver(([entry]) => {
        area.width = entry.contentRect.width;
        area.height = entry.contentRect.height;
        layOut();
    }).observe(viewArea);
}

function listenToControls() {
    for (const name of ['algorithm', 'quality', 'tone']) {
        byId(name).addEventListener('change', (event) => change({ [name]: event.target.value }));
    }
    byId('size').addEventListener('change', (event) => {
        change({ size: event.target.value.split('x').map(Number) });
        layOut();
    });
    byId('sample-limit').addEventListener('change', (event) => {
        change({ samples: Number(event.target.value) });
    });
    byId('camera').addEventListener('change', (event) => jumpTo(event.target.value));
    byId('exposure').addEventListener('input', (event) => setExposure(event.target.value));
    byId('exposure-number').addEventListener('change', (event) => setExposure(event.target.value));
    byId('exposure-reset').addEventListener('click', () => setExposure('0'));
    byId('reset-view').addEventListener('click', resetView);
    byId('pause').addEventListener('click', togglePause);
    for (const kind of ['png', 'exr', 'preset', 'edits']) {
        byId(`save-${kind}`).addEventListener('click', () => save(kind));
    }
    byId('copy').addEventListener('click', copyCommand);
    byId('copy-a').addEventListener('click', copyCommand);
    byId('help-button').addEventListener('click', toggleHelp);
    byId('collapse').addEventListener('click', () => {
        setCollapsed(!document.body.classList.contains('collapsed'));
    });
    byId('connect-again').addEventListener('click', connect);
}

setCollapsed(narrow.matches);
listenToView();
listenToControls();
listenToPanes();
listenToEdits();
listenToTimeline();
listenToJudging();
connect();
