// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// This shows what is sampled and what it takes, how true the picture is, and what settings cost.

'use strict';

const HISTORY_LENGTH = 60;
const SVG = 'http://www.w3.org/2000/svg';
const TELLABLE = 2;  // times the floor: an error as large as this is not noise of the reference
const PLOT = { left: 44, right: 300, top: 12, bottom: 168 };
const LABEL_GAP = 56;  // between times on the plot's axis
const NUMBER_PLACES = [[0, -11], [13, 5], [-13, 5], [0, 20]];  // of a number beside its point
const NUMBER_ROOM = 13;

/** Makes an element of a drawing. */
function drawn(name, attributes, text) {
    const element = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    if (text !== undefined) element.textContent = text;
    return element;
}

// --------------------------------------------------------------------------------- overlays

const overlays = { names: [] };

/** Names an overlay for people. */
function overlayText(name) {
    if (name === 'error') return 'error against the reference';
    const [component, kind] = name.split('.');
    const kinds = {
        level: 'levels', samples: 'samples', error: 'errors',
        error_middle: 'errors of the middle level',
    };
    return `${component}: ${kinds[kind] ?? kind}`;
}

function showOverlays(names) {
    const select = byId('overlay');
    if (names.join() !== overlays.names.join() || select.options.length === 0) {
        overlays.names = names;
        select.replaceChildren(new Option('None', ''),
            ...names.map((name) => new Option(overlayText(name), name)));
    }
    const chosen = session.settings?.overlay ?? '';
    setChoice('overlay', chosen);
    showLegend(chosen);
}

function showLegend(name) {
    const ends = {
        level: ['coarse', 'full'], samples: ['none (grey)', 'sampled'],
        error: ['0.5 just noticeable', '128'], error_middle: ['0.5 just noticeable', '128'],
    };
    const [low, high] = name === 'error' ? ['same', 'far off']
        : ends[name.split('.')[1]] ?? ['low', 'high'];
    byId('legend').hidden = name === '';
    byId('legend-low').textContent = low;
    byId('legend-high').textContent = high;
}

function chooseOverlay(name) {
    change({ overlay: name });
    showLegend(name);
}

/** Chooses the next overlay, or none after the last. */
function nextOverlay() {
    if (!session.camera || overlays.names.length === 0) return;
    const at = overlays.names.indexOf(session.settings.overlay);
    byId('sampling').open = true;
    chooseOverlay(overlays.names[at + 1] ?? '');
    byId('overlay').value = session.settings.overlay;
}

function showRecords(records) {
    const line = byId('records');
    line.hidden = !records;
    if (records) {
        line.textContent = `Records kept: ${whole.format(records.kept)}, of these updated: `
            + `${whole.format(records.updated)}; dropped: ${whole.format(records.dropped)}`;
    }
}

const sampleTimes = [];

/** Draws what the last samples took. */
function showHistory(status) {
    if (!Number.isFinite(status.ms)) return;
    sampleTimes.push(status.ms);
    if (sampleTimes.length > HISTORY_LENGTH) sampleTimes.shift();
    const most = Math.max(...sampleTimes, 1);
    const points = sampleTimes.map((ms, i) => {
        const x = (300 * i) / (HISTORY_LENGTH - 1);
        return `${x.toFixed(1)},${(39 - (37 * ms) / most).toFixed(1)}`;
    });
    byId('history').replaceChildren(drawn('polyline', { points: points.join(' ') }));
    const now = oneDecimal.format(status.ms);
    byId('history-title').textContent =
        `ms per sample, lately: ${now}, at most ${oneDecimal.format(most)}`;
}

// ------------------------------------------------------------------------------------ trust

function toggleTrust() {
    if (!session.camera) return;
    byId('judging').open = true;
    change({ trust: !session.settings.trust });
    if (!session.settings.trust) showTrust({ samples: 0, panes: [] });
    showTrustState();
}

function showTrustState() {
    const on = session.settings.trust;
    byId('trust').setAttribute('aria-pressed', String(on));
    byId('trust').textContent = on ? 'Stop judging' : 'Judge it by a reference';
    if (!on && report.trust?.samples > 0) showTrust({ samples: 0, panes: [] });
}

const percent = (value) => `${writeValue(value)} %`;

/** Takes in a judgement; one of a picture from before what the page has asked for is void. */
function receiveTrust(trust) {
    const isCurrent = (report.status?.state ?? 0) >= report.pictureState;
    showTrust(isCurrent ? trust : { ...trust, panes: [] });
}

function forgetJudgement() {
    if (report.trust?.panes.length > 0) showTrust({ ...report.trust, panes: [] });
}

/** Says of each picture whether its error is told apart from the noise of the reference. */
function trustWords({ panes: judged, floor }) {
    return judged.map((errors) => {
        const name = judged.length > 1 ? `Picture ${'AB'[errors.pane]}` : 'The picture';
        return errors.hdrflip > TELLABLE * floor.hdrflip
            ? `${name}’s error is clearly larger than the reference’s own noise.`
            : `${name}’s error is hidden by the reference’s own noise: wait for a better one.`;
    }).join(' ');
}

/** Shows a judgement: errors of the pictures, and what the reference's noise alone would be. */
function showTrust(trust) {
    report.trust = trust;
    const judged = trust.panes.length > 0;
    byId('trust-table').hidden = !judged;
    byId('trust-words').textContent = judged ? trustWords(trust) : '';
    byId('trust-state').textContent = trust.samples > 0
        ? `Reference samples: 2 × ${whole.format(trust.samples)}`
        : 'A reference in two halves grows in a quarter of the time, and tells how far the picture '
            + 'is from the truth.';
    if (!judged) return;
    const of = (pane, text) => {
        const found = trust.panes.find((one) => one.pane === pane);
        return found ? text(found) : NOTHING;
    };
    const relmse = (errors) => (errors.relmse ? `${writeValue(errors.relmse.value)} (`
        + `${writeValue(errors.relmse.low)} to ${writeValue(errors.relmse.high)})` : NOTHING);
    const rows = [
        ['Samples', (errors) => whole.format(errors.samples), NOTHING],
        ['relMSE, unbiased', relmse, NOTHING],
        ['HDR-FLIP', (errors) => writeValue(errors.hdrflip), writeValue(trust.floor.hdrflip)],
        ['HDR-VDP 75 %', (errors) => percent(errors.vdp), percent(trust.floor.vdp)],
    ];
    byId('trust-a').textContent = trust.panes.length > 1 ? 'A' : 'Picture';
    byId('trust-b').textContent = trust.panes.length > 1 ? 'B' : '';
    byId('trust-rows').replaceChildren(...rows.map(([name, text, floor]) => {
        const second = trust.panes.length > 1 ? of(1, text) : '';
        return valueRow(name, [of(0, text), second, floor]);
    }));
}

// ------------------------------------------------------------------------------------ costs

function measure() {
    if (!session.camera) return;
    request({ measure: !report.front?.running });
}

function adopt(index) {
    forgetJudgement();
    request({ adopt: index });
}

/** Says how far measuring has come, or what to do with the points. */
function frontText(front, points) {
    if (front.running) return `Measuring: ${Math.round(100 * front.done)} % done`;
    if (points.some((point) => point.error < TELLABLE * front.floor)) {
        return 'Choose a point to use its settings. Errors below twice the dashed line are mostly '
            + 'the noise of the reference.';
    }
    if (points.length > 0) return 'Choose a point to use its settings.';
    return 'Renders this view with several settings, and compares their times and errors.';
}

/** Shows what was measured: a plot, and the same as numbers. */
function showFront(front) {
    report.front = front;
    const points = front.points.filter((point) => Number.isFinite(point.error ?? NaN));
    byId('measure').textContent = front.running ? 'Stop measuring'
        : 'Measure settings on this view';
    byId('front-state').textContent = frontText(front, points);
    byId('front').toggleAttribute('hidden', points.length === 0);
    byId('front-table').hidden = points.length === 0;
    const focused = document.activeElement?.dataset?.adopts;
    const isInPlot = document.activeElement?.matches('circle');
    byId('front-rows').replaceChildren(...points.map(frontRow));
    if (points.length > 0) drawFront(points, front.floor);
    if (focused === undefined) return;
    const place = byId(isInPlot ? 'front' : 'front-rows');
    place.querySelector(`[data-adopts="${focused}"]`)?.focus();
}

function frontRow(point, i) {
    const name = `${i + 1}: ${point.name}`;
    const row = valueRow(name, [whole.format(point.ms), writeValue(point.error)]);
    const cell = document.createElement('td');
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = point.shown ? 'In use' : 'Use';
    button.setAttribute('aria-label', `Use ${name}`);
    button.dataset.adopts = point.index;
    button.onclick = () => adopt(point.index);
    cell.append(button);
    row.append(cell);
    return row;
}

/** Steps for an axis from 0 to `most`: one, two or five times a power of ten. */
function niceStep(most, count) {
    const power = 10 ** Math.floor(Math.log10(most / count));
    return [1, 2, 5, 10].map((factor) => factor * power).find((step) => most / step <= count);
}

/** Times for the axis, the roundest first, as many as there is room for. */
function axisTimes(least, most, x) {
    const times = [];
    for (const factor of [1, 3, 2, 5, 1.5, 7]) {
        for (let power = Math.floor(Math.log10(least)); power <= Math.log10(most); power += 1) {
            const ms = Number((factor * 10 ** power).toPrecision(2));
            const hasRoom = times.every((other) => Math.abs(x(ms) - x(other)) >= LABEL_GAP);
            if (ms >= least && ms <= most && hasRoom) times.push(ms);
        }
    }
    return times;
}

/** Numbers points as their rows are, each beside its own where no other point or number is. */
function drawNumbers(marks) {
    const taken = [...marks];
    return marks.map(([x, y], i) => {
        const places = NUMBER_PLACES.map(([right, down]) => [x + right, y + down]);
        const isFree = ([left, base]) => taken.every((other) => other === marks[i]
            || Math.max(Math.abs(other[0] - left), Math.abs(other[1] - base + 5)) >= NUMBER_ROOM);
        const [left, base] = places.find(isFree) ?? places[0];
        taken.push([left, base - 5]);
        return drawn('text', { class: 'number', x: left, y: base, 'text-anchor': 'middle' },
            String(i + 1));
    });
}

/** Draws error over time, the time on a logarithmic scale. */
function drawFront(points, floor) {
    const least = Math.min(...points.map((point) => point.low_ms)) / 1.3;
    const most = Math.max(...points.map((point) => point.high_ms)) * 1.3;
    const highest = 1.15 * Math.max(...points.map((point) => point.error), floor ?? 0);
    const x = (ms) => PLOT.left
        + ((PLOT.right - PLOT.left) * Math.log(ms / least)) / Math.log(most / least);
    const y = (error) => PLOT.bottom - ((PLOT.bottom - PLOT.top) * error) / highest;
    const parts = [];
    const step = niceStep(highest, 4);
    for (let value = 0; value <= highest; value += step) {
        parts.push(drawn('line', {
            class: 'grid', x1: PLOT.left, x2: PLOT.right, y1: y(value), y2: y(value),
        }));
        parts.push(drawn('text', { x: PLOT.left - 4, y: y(value) + 4, 'text-anchor': 'end' },
            String(Number(value.toPrecision(2)))));
    }
    for (const ms of axisTimes(least, most, x)) {
        parts.push(drawn('text', { x: x(ms), y: PLOT.bottom + 16, 'text-anchor': 'middle' },
            ms < 1000 ? `${ms} ms` : `${ms / 1000} s`));
    }
    parts.push(drawn('text', { x: PLOT.left, y: PLOT.bottom + 31 },
        'HDR-FLIP over time; dashed: the noise'));
    if (Number.isFinite(floor ?? NaN)) {
        parts.push(drawn('line', {
            class: 'floor', x1: PLOT.left, x2: PLOT.right, y1: y(floor), y2: y(floor),
        }));
    }
    const front = points.filter((point) => point.on_front).sort((a, b) => a.ms - b.ms);
    parts.push(drawn('polyline', {
        class: 'front-line', points: front.map((one) => `${x(one.ms)},${y(one.error)}`).join(' '),
    }));
    points.forEach((point, i) => parts.push(...drawPoint(point, i, x, y)));
    parts.push(...drawNumbers(points.map((point) => [x(point.ms), y(point.error)])));
    byId('front').replaceChildren(...parts);
}

/** Draws a point that can be chosen, and the range of its times. */
function drawPoint(point, i, x, y) {
    const figures = `${whole.format(point.ms)} ms, HDR-FLIP ${writeValue(point.error)}`;
    const text = `${i + 1}: ${point.name}, ${figures}`;
    const mark = drawn('circle', {
        class: point.on_front ? 'point on-front' : 'point', cx: x(point.ms), cy: y(point.error),
        r: point.shown ? 8 : 6, tabindex: 0, role: 'button', 'aria-label': `Use ${text}`,
        'data-adopts': point.index,
    });
    mark.append(drawn('title', {}, text));
    mark.addEventListener('click', () => adopt(point.index));
    mark.addEventListener('keydown', (event) => {
        if (event.key !== 'Enter' && event.key !== ' ') return;
        event.preventDefault();
        adopt(point.index);
    });
    const range = drawn('line', {
        class: 'range', x1: x(point.low_ms), x2: x(point.high_ms), y1: y(point.error),
        y2: y(point.error),
    });
    return [range, mark];
}

function listenToJudging() {
    byId('overlay').addEventListener('change', (event) => chooseOverlay(event.target.value));
    byId('trust').addEventListener('click', toggleTrust);
    byId('measure').addEventListener('click', measure);
}
