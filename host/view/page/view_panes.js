// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// This shows picture A, and where the view is compared picture B to the right of a border that can
// be dragged.

'use strict';

const BORDER_STEP = 0.02;  // of the picture's width, that a key moves the border

/** The panes are the last frames of pictures A and B, each on a canvas of its own. */
const panes = [null, null].map(() => ({ canvas: document.createElement('canvas'), frame: null }));

/** The border between both, as a share of the picture's width. */
const border = { share: 0.5, dragged: false };

const comparison = () => session.settings?.compare ?? null;

/** Keeps a frame's picture, until there is another of its pane. */
function keepPane(frame, bitmap) {
    const pane = panes[frame.pane];
    if (!pane) return;
    pane.canvas.width = frame.width;
    pane.canvas.height = frame.height;
    pane.canvas.getContext('2d', { alpha: false }).drawImage(bitmap, 0, 0);
    const { image, ...shown } = frame;
    pane.frame = shown;
}

function forgetPanes() {
    for (const pane of panes) pane.frame = null;
}

/** A pane counts when it shows all that the page has asked for. */
function isCurrent(pane) {
    return pane.frame !== null && !pane.frame.moving && pane.frame.state >= report.pictureState;
}

/** Puts the panes on the canvas, which has as many pixels as the larger of them. */
function drawPanes() {
    const [a, b] = panes;
    const both = comparison() !== null && isCurrent(b);
    const size = both && b.frame.width > a.frame.width ? b.frame : a.frame;
    if (canvas.width !== size.width) canvas.width = size.width;
    if (canvas.height !== size.height) canvas.height = size.height;
    context.imageSmoothingEnabled = a.frame.moving;
    context.drawImage(a.canvas, 0, 0, size.width, size.height);
    if (both) {
        const from = Math.round(border.share * size.width);
        context.save();
        context.beginPath();
        context.rect(from, 0, size.width - from, size.height);
        context.clip();
        context.drawImage(b.canvas, 0, 0, size.width, size.height);
        context.restore();
    }
    showPaneLabels();
}

/** Says what a pane shows, or that it is to come. */
function paneText(name, pane, algorithm, quality) {
    const exact = algorithm === 'path' || algorithm === 'reference';
    const setting = exact ? algorithm : `${algorithm} ${quality}`;
    if (!isCurrent(pane)) return `${name} ${setting}: waiting`;
    return `${name} ${setting}, samples: ${whole.format(pane.frame.samples)}`;
}

function showPaneLabels() {
    const compared = comparison();
    const labels = [byId('label-a'), byId('label-b')];
    for (const label of labels) label.hidden = !compared;
    byId('divider').hidden = !compared;
    if (!compared) return;
    const { algorithm, quality } = session.settings;
    labels[0].textContent = paneText('A', panes[0], algorithm, quality);
    labels[1].textContent = paneText('B', panes[1], compared.algorithm, compared.quality);
}

/** Puts border and labels where the picture is. */
function placeDivider() {
    const divider = byId('divider');
    const left = canvas.offsetLeft + border.share * canvas.offsetWidth;
    divider.style.left = `${left}px`;
    divider.style.top = `${canvas.offsetTop}px`;
    divider.style.height = `${canvas.offsetHeight}px`;
    divider.setAttribute('aria-valuenow', String(Math.round(100 * border.share)));
    byId('label-a').style.left = `${canvas.offsetLeft}px`;
    byId('label-a').style.top = `${canvas.offsetTop}px`;
    const right = viewArea.clientWidth - canvas.offsetLeft - canvas.offsetWidth;
    byId('label-b').style.right = `${right}px`;
    byId('label-b').style.top = `${canvas.offsetTop}px`;
}

function moveBorder(share) {
    border.share = clamp(share, 0, 1);
    if (report.lastFrame) drawPanes();
    placeDivider();
}

/** Asks for the comparison that the controls name, or for an end of it. */
function askForComparison(on) {
    const compare = {
        algorithm: byId('algorithm-b').value,
        quality: byId('quality-b').value,
        seconds: Number(byId('seconds').value),
    };
    change({ compare: on ? compare : null });
    showComparison();
}

function toggleComparison() {
    if (!session.camera) return;
    byId('comparison').open = true;
    askForComparison(!comparison());
}

/** Brings the controls of the comparison in step with the settings. */
function showComparison() {
    const compared = comparison();
    byId('compare').setAttribute('aria-pressed', String(compared !== null));
    byId('compare').textContent = compared ? 'Show picture A alone' : 'Compare with picture B';
    if (compared) {
        setChoice('algorithm-b', compared.algorithm);
        setChoice('quality-b', compared.quality);
        setChoice('seconds', String(compared.seconds));
    }
    if (report.lastFrame) {
        drawPanes();
        placeDivider();
    }
}

/** The command of picture B, empty where there is none yet. */
let commandB = '';

function setCommandB(command) {
    commandB = command ?? '';
    byId('copy-b').disabled = commandB === '';
}

function listenToPanes() {
    const divider = byId('divider');
    const shareAt = (event) => {
        const box = canvas.getBoundingClientRect();
        return (event.clientX - box.left) / box.width;
    };
    divider.addEventListener('pointerdown', (event) => {
        event.stopPropagation();
        divider.setPointerCapture(event.pointerId);
        border.dragged = true;
    });
    divider.addEventListener('pointermove', (event) => {
        event.stopPropagation();
        if (border.dragged) moveBorder(shareAt(event));
    });
    for (const kind of ['pointerup', 'pointercancel']) {
        divider.addEventListener(kind, (event) => {
            event.stopPropagation();
            border.dragged = false;
        });
    }
    divider.addEventListener('keydown', (event) => {
        const shares = {
            ArrowLeft: border.share - BORDER_STEP,
            ArrowRight: border.share + BORDER_STEP,
            Home: 0,
            End: 1,
        };
        if (event.key in shares) moveBorder(shares[event.key]);
    });
    byId('compare').addEventListener('click', toggleComparison);
    for (const id of ['algorithm-b', 'quality-b', 'seconds']) {
        byId(id).addEventListener('change', () => {
            if (comparison()) askForComparison(true);
        });
    }
    byId('copy-b').addEventListener('click', () => copyText(commandB, byId('command')));
}
