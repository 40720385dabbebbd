// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// This edits the scene, and plays its animation: it tells the server what changes, and shows how
// the scene is now.

'use strict';

const MOST_EDITS_SHOWN = 6;
const STEP_SHARE = 0.01;     // of the scene's radius, that a step moves something
const SETTLE_TIME = 300;     // milliseconds without a change that end the motion of an edit
const MOVE_FIELDS = ['move-x', 'move-y', 'move-z'];
const RELATIVE_FIELDS = [...MOVE_FIELDS, 'emission', 'intensity', 'turn', 'scale'];

/** The editing is what is being changed, and the changes to send. */
const editing = {
    target: null,   // { kind: 'object', 'material' or 'light', name }
    queue: [],      // changes to send
    turn: 0,        // counts interactions: a slider that is dragged, a field that is typed in
    begun: false,   // a change of this interaction was queued
    change: null,   // the last one, sent again at rest
    moving: false,  // it said that more follow
    timer: 0,
    drags: false,   // dragging in the picture moves the object
    dragged: [0, 0, 0],
    picked: null,   // the last object that was picked, and the point where
    offered: '',    // the names that the select has
};

/** The timeline is the animation as it plays. */
const timeline = { playing: false, moving: false, begin: 0, first: 0 };

// ------------------------------------------------------------------------------------ edits

/** Queues a change of the target; those of one interaction replace each other. */
function edit(change, moving) {
    if (!session.camera || !editing.target) return;
    const body = { [editing.target.kind]: editing.target.name, ...change };
    const last = editing.queue.at(-1);
    if (last && last.turn === editing.turn) Object.assign(last, { body, moving });
    else editing.queue.push({ body, moving, continues: editing.begun, turn: editing.turn });
    editing.begun = true;
    editing.change = change;
    editing.moving = moving;
    clearTimeout(editing.timer);
    if (moving) editing.timer = setTimeout(() => edit(change, false), SETTLE_TIME);
    requestTick();
}

/** Ends an interaction: the next change is an edit of its own, from how things are then. */
function endEdit() {
    if (!editing.begun) return;
    clearTimeout(editing.timer);
    if (editing.moving) edit(editing.change, false);
    editing.begun = false;
    editing.turn += 1;
    for (const id of RELATIVE_FIELDS) byId(id).value = '0';
}

/** Forgets what was being edited and played: a session begins. */
function forgetEditing() {
    clearTimeout(editing.timer);
    Object.assign(editing, { queue: [], begun: false, dragged: [0, 0, 0], picked: null });
    timeline.playing = false;
}

/** Sends the queued changes; called once an animation frame. */
function sendEdits() {
    for (const { body, moving, continues } of editing.queue) {
        send(session.socket, { edit: body, moving, continues, state: nextState() });
    }
    editing.queue = [];
}

function undo(what) {
    if (!session.camera || !report.scene?.edits.length) return;
    endEdit();
    sendChanges();
    send(session.socket, { undo: what, state: nextState() });
}

/** Takes in what can be edited, and the edits so far. */
function receiveScene(scene) {
    report.scene = scene;
    fillTargets(scene);
    showTarget();
    showEdits(scene.edits);
    showTimeline();
}

function fillTargets(scene) {
    const groups = [
        ['Objects', 'object', scene.objects],
        ['Materials', 'material', scene.materials.map((one) => one.name)],
        ['Lights', 'light', scene.lights.map((one) => one.name)],
    ];
    // There may be thousands, and most edits leave them as they are.
    const offered = JSON.stringify(groups);
    if (offered === editing.offered) return;
    editing.offered = offered;
    const select = byId('target');
    select.replaceChildren(new Option('Nothing', ''));
    for (const [label, kind, names] of groups) {
        if (names.length === 0) continue;
        const group = document.createElement('optgroup');
        group.label = label;
        group.append(...names.map((name) => new Option(name, `${kind} ${name}`)));
        select.append(group);
    }
}

const targetValue = () => (editing.target ? `${editing.target.kind} ${editing.target.name}` : '');

function chooseTarget(kind, name) {
    endEdit();
    editing.target = name ? { kind, name } : null;
    showTarget();
}

/** Shows the fields of the target, and how it is now. */
function showTarget() {
    const select = byId('target');
    select.value = targetValue();
    if (select.value !== targetValue()) editing.target = null;
    if (!editing.target) select.value = '';
    const { kind, name } = editing.target ?? {};
    if (kind !== 'object') setDragging(false);
    const light = kind === 'light' ? report.scene.lights.find((one) => one.name === name) : null;
    const moves = kind === 'object' || (light && light.type !== 'directional');
    byId('edit-object-fields').hidden = kind !== 'object';
    byId('edit-light-fields').hidden = kind !== 'light';
    byId('edit-move-fields').hidden = !moves;
    byId('edit-material-fields').hidden = kind !== 'material';
    const step = Number((STEP_SHARE * sceneRadius()).toPrecision(1));
    for (const id of MOVE_FIELDS) byId(id).step = String(step);
    const material = kind === 'material' ? materialNamed(name) : null;
    if (material && !editing.begun) showMaterial(material);
}

const materialNamed = (name) => report.scene.materials.find((one) => one.name === name);
const isDark = (material) => material.emission.every((value) => value === 0);

function showMaterial(material) {
    byId('albedo').value = hexOf(material.albedo);
    byId('roughness-field').hidden = material.roughness === null;
    if (material.roughness !== null) byId('roughness').value = material.roughness;
    byId('emission-fields').hidden = isDark(material);
    if (isDark(material)) return;
    const brightest = Math.max(...material.emission);
    byId('emission-colour').value = hexOf(scale(material.emission, 1 / brightest));
}

/** The target's emission in another colour; its largest part stays as large, so that it shines. */
function emissionOf(hex) {
    const colour = linearOf(hex);
    const factor = Math.max(...materialNamed(editing.target.name).emission)
        / (Math.max(...colour) || 1);
    return colour.map((value) => Number((value * factor).toPrecision(6)));
}

/** Writes a linear colour as browsers write those of a screen. */
function hexOf(colour) {
    const encoded = (value) => (value <= 0.0031308 ? 12.92 * value
        : 1.055 * value ** (1 / 2.4) - 0.055);
    const digits = (value) => Math.round(255 * clamp(encoded(value), 0, 1))
        .toString(16).padStart(2, '0');
    return `#${colour.map(digits).join('')}`;
}

/** Reads such a colour as a linear one. */
function linearOf(hex) {
    return [1, 3, 5].map((i) => {
        const value = parseInt(hex.slice(i, i + 2), 16) / 255;
        const linear = value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
        return Number(linear.toPrecision(6));
    });
}

const writeValues = (values) => [values].flat().map(writeValue).join(', ');

/** Names an axis of the world by its letter, and any other by its numbers. */
function axisText(axis) {
    const along = ['x', 'y', 'z'].filter((_, i) => axis[i] !== 0);
    return along.length === 1 ? along[0] : writeValues(axis);
}

/** What the keys of an edit say, in words. */
const EDIT_WORDS = new Map([
    ['move', (by) => `moved by ${writeValues(by)}`],
    ['rotate', (turn) => `turned by ${writeValue(turn.degrees)}° about ${axisText(turn.axis)}`],
    ['scale', (factor) => `size × ${writeValues(factor)}`],
    ['remove', () => 'removed'],
    ['add', (copy) => `copied as ${copy.name}`],
    ['intensity', (factor) => `brightness × ${writeValue(factor)}`],
    ['albedo', (colour) => `colour ${hexOf(colour)}`],
    ['emission', (light) => `light ${writeValues(light)}`],
    ['emission_factor', (factor) => `light × ${writeValue(factor)}`],
    ['roughness', (value) => `roughness ${writeValue(value)}`],
]);

/** Says in a few words what an edit does. */
function editText(one) {
    const target = one.object ?? one.material ?? one.light;
    const words = Object.entries(one).filter(([key]) => EDIT_WORDS.has(key))
        .map(([key, value]) => EDIT_WORDS.get(key)(value));
    const when = report.scene.frames > 1 ? `, from frame ${one.frame} on` : '';
    return `${target}: ${words.join(', ')}${when}`;
}

function showEdits(edits) {
    const list = byId('edits');
    const first = Math.max(0, edits.length - MOST_EDITS_SHOWN);
    list.replaceChildren(...edits.slice(first).map((one) => {
        const item = document.createElement('li');
        item.textContent = editText(one);
        item.title = JSON.stringify(one);
        return item;
    }));
    byId('edits-hint').textContent = editsHint(edits.length, first);
    byId('undo').disabled = edits.length === 0;
    byId('undo-all').disabled = edits.length === 0;
}

/** Says how many edits there are, and that the first of them are not in the list. */
function editsHint(count, hidden) {
    if (count === 0) return 'No edits yet.';
    const shown = hidden > 0 ? `, the last ${count - hidden} of them:` : ':';
    return `${count} ${count === 1 ? 'edit' : 'edits'}${shown}`;
}

/** Offers to edit what was picked. */
function offerEdits(picked) {
    editing.picked = picked;
    const offer = (id, kind, name, list) => {
        const button = byId(id);
        button.hidden = !name || !list.includes(name);
        button.textContent = `Edit ${kind} ${name}`;
        button.onclick = () => {
            byId('edit').open = true;
            chooseTarget(kind, name);
            byId('target').focus();
        };
    };
    const materials = report.scene.materials.map((one) => one.name);
    offer('edit-object', 'object', picked.object, report.scene.objects);
    offer('edit-material', 'material', picked.material, materials);
    if (byId('edit').open && report.scene.objects.includes(picked.object)
        && editing.target?.kind !== 'material') chooseTarget('object', picked.object);
    else if (byId('edit').open && materials.includes(picked.material)
        && editing.target?.kind === 'material') chooseTarget('material', picked.material);
}

/** Lets dragging in the picture move the object, or the view again. */
function setDragging(on) {
    const can = on && editing.target?.kind === 'object';
    if (on && !can) showMessage('Choose an object to edit first.', 'notice');
    editing.drags = can;
    byId('drag-object').setAttribute('aria-pressed', String(can));
    viewArea.classList.toggle('moves-object', can);
}

/** The point where the target was picked; null where it was chosen by name. */
function pickedPoint() {
    const isTarget = editing.picked && editing.picked.object === editing.target?.name;
    return isTarget ? editing.picked.point : null;
}

/** Moves the object by a drag's pixels, in the picture's plane, where it was picked. */
function dragObject([x, y]) {
    const { right, up, forward } = axesOf(session.camera);
    const point = pickedPoint();
    const depth = point
        ? dot(subtract(point, session.camera.from), forward)
        : distanceOf(session.camera);
    const height = visibleHeight(session.camera) * (session.camera.orthographic ? 1
        : Math.max(depth, 0) / distanceOf(session.camera));
    const rate = height / canvas.clientHeight;
    editing.dragged = add(editing.dragged, add(scale(right, x * rate), scale(up, -y * rate)));
    edit({ move: editing.dragged.map((value) => Number(value.toPrecision(9))) }, true);
}

function endObjectDrag() {
    endEdit();
    const point = pickedPoint();
    if (point) editing.picked.point = add(point, editing.dragged);
    editing.dragged = [0, 0, 0];
}

// --------------------------------------------------------------------------------- timeline

function showTimeline() {
    const frames = report.scene?.frames ?? 1;
    byId('timeline').hidden = frames < 2;
    if (frames < 2 || !session.settings) return;
    const slider = byId('frame');
    slider.max = String(frames - 1);
    slider.value = String(session.settings.frame);
    const seconds = session.settings.frame / report.scene.frame_rate;
    byId('frame-text').textContent =
        `${session.settings.frame} of ${frames - 1}, ${seconds.toFixed(2)} s`;
    byId('play').textContent = timeline.playing ? 'Stop' : 'Play';
}

function goToFrame(frame, moving) {
    if (!session.camera) return;
    timeline.moving = moving;
    change({ frame });
    showTimeline();
}

function stepFrame(by) {
    const frames = report.scene?.frames ?? 1;
    if (frames < 2 || !session.settings) return;
    timeline.playing = false;
    goToFrame((session.settings.frame + by + frames) % frames, false);
}

function togglePlay() {
    if (!session.camera) return;
    timeline.playing = !timeline.playing;
    timeline.begin = performance.now();
    timeline.first = session.settings.frame;
    if (!timeline.playing) goToFrame(session.settings.frame, false);
    showTimeline();
    requestTick();
}

/** Asks for the frame of this moment, once the one before has been shown. */
function playTimeline(now) {
    const { lastFrame } = report;
    if (!timeline.playing || !lastFrame || lastFrame.state < report.pictureState) return;
    const { frames, frame_rate: rate } = report.scene;
    const passed = Math.floor(((now - timeline.begin) / 1000) * rate);
    const frame = (timeline.first + Math.max(passed, 0)) % frames;
    if (frame !== session.settings.frame) goToFrame(frame, true);
}

function listenToTimeline() {
    byId('play').addEventListener('click', togglePlay);
    byId('frame').addEventListener('input', (event) => {
        timeline.playing = false;
        goToFrame(Number(event.target.value), true);
    });
    byId('frame').addEventListener('change', (event) => {
        goToFrame(Number(event.target.value), false);
    });
}

// ---------------------------------------------------------------------------------- fields

/**
 * Lets a field change the target: `changeOf` makes the change of its text. Each press of a key is a
 * change, so that there an edit lasts until the field loses the focus.
 */
function listenToField(id, changeOf) {
    const field = byId(id);
    let hasKeys = false;
    const changes = (moving) => {
        if (editing.target) edit(changeOf(field.value), moving);
    };
    field.addEventListener('pointerdown', () => {
        endEdit();
        hasKeys = false;
    });
    field.addEventListener('keydown', () => {
        hasKeys = true;
    });
    field.addEventListener('blur', endEdit);
    field.addEventListener('input', () => changes(true));
    field.addEventListener('change', () => {
        changes(false);
        if (!hasKeys) endEdit();
    });
}

function listenToEdits() {
    byId('target').addEventListener('change', (event) => {
        const at = event.target.value.indexOf(' ');
        chooseTarget(event.target.value.slice(0, at), event.target.value.slice(at + 1));
    });
    const stops = (text) => Number((2 ** Number(text)).toPrecision(6));
    listenToField('albedo', (text) => ({ albedo: linearOf(text) }));
    listenToField('roughness', (text) => ({ roughness: Number(text) }));
    listenToField('emission-colour', (text) => ({ emission: emissionOf(text) }));
    listenToField('emission', (text) => ({ emission_factor: stops(text) }));
    listenToField('intensity', (text) => ({ intensity: stops(text) }));
    listenToField('scale', (text) => ({ scale: stops(text) }));
    listenToField('turn', (text) => {
        const axis = [0, 0, 0];
        axis[Number(byId('turn-axis').value)] = 1;
        return { rotate: { axis, degrees: Number(text) } };
    });
    const moved = () => ({ move: MOVE_FIELDS.map((id) => Number(byId(id).value) || 0) });
    for (const id of MOVE_FIELDS) {
        byId(id).addEventListener('input', () => edit(moved(), true));
        byId(id).addEventListener('blur', (event) => {
            if (!MOVE_FIELDS.includes(event.relatedTarget?.id)) endEdit();
        });
    }
    byId('remove').addEventListener('click', () => {
        endEdit();
        edit({ remove: true }, false);
        endEdit();
    });
    byId('drag-object').addEventListener('click', () => setDragging(!editing.drags));
    byId('undo').addEventListener('click', () => undo('last'));
    byId('undo-all').addEventListener('click', () => undo('all'));
}
