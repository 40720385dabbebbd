// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// This is the program of `weft view`'s page: it shows the frames that the renderer sends, and tells
// it where the camera goes and what the settings are. What lies in other files: the panes of a
// comparison (view_panes.js), edits and the animation (view_edit.js), what is measured and judged
// (view_judge.js) and how all of it begins (view_start.js).

'use strict';

const POLE_GAP = Math.PI / 180;      // the least angle between `up` and the view, radians
const LEVEL_COSINE = 1 - 1e-6;       // two directions this close count as the same
const FLY_SPEED = 0.5;               // scene radii per second
const TURN_SPEED = Math.PI / 3;      // radians per second
const FAST = 4;                      // how many times faster keys move with Shift
const FIRST_STEP = 1 / 60;           // seconds that a key counts for when it goes down
const LONGEST_STEP = 0.1;            // seconds; a longer gap between two frames counts as this
const WHEEL_REST = 150;              // milliseconds without a wheel event that end its motion
const WHEEL_RATE = 0.001;            // logarithm of the distance per pixel of wheel
const WHEEL_LIMIT = 500;             // pixels of wheel that one event may count for
const WHEEL_UNITS = [1, 16, 400];    // pixels per unit of WheelEvent.deltaMode
const PINCH_WHEEL = 10;              // how much more a touchpad's pinch counts than its scrolling
const MIDDLE_DRAG_RATE = 0.005;      // logarithm of the distance per pixel of a middle drag
const MOUSE_SLOP = 4;                // pixels that a click may move
const TOUCH_SLOP = 10;
const DOUBLE_CLICK = { time: 400, distance: 24 };  // milliseconds, pixels
const EXPOSURE_LIMIT = 10;           // stops
const SIDES = [256, 384, 512, 768, 1024];
const PICTURE_STAYS = new Set(['paused', 'overlay', 'trust']);  // settings that change no picture
const RECOLOURS = new Set(['exposure', 'tone']);  // settings that change no picture's errors
const SAMPLE_LIMITS = [0, 1, 6, 16, 64, 256];
const MOST_STAGES = 12;
const MOST_MESSAGES = 4;
const NOTICE_TIME = 8000;            // milliseconds that a notice stays
const FRAME_HEADER = 28;             // bytes
const FRAME_MAGIC = 0x31544657;      // 'WFT1', read as a little-endian number
const FRAME_TYPES = ['image/jpeg', 'image/png'];
const MOVING = 1;                    // flags of a frame
const FINAL = 2;
const NOTHING = '–';
const PHASES = {
    moving: 'Moving', refining: 'Refining', finished: 'Finished', paused: 'Paused',
    measuring: 'Measuring',
};

const byId = (id) => document.getElementById(id);
const canvas = byId('canvas');
const viewArea = byId('view');
const context = canvas.getContext('2d', { alpha: false });
const narrow = window.matchMedia('(max-width: 760px)');

/** The report is for browser tests, which read it and change nothing. */
const report = {
    state: 0,         // the number of the last message that has one
    pictureState: 0,  // the last of these that changes what pictures show
    sent: 0,          // text messages sent, of every kind
    frames: 0,        // frames drawn
    lastFrame: null,  // the frame on the canvas
    lastFrameB: null, // that of picture B
    scene: null,      // what can be edited, and the edits
    trust: null,      // the last judgement
    front: null,      // what was measured
    status: null,     // the last status of the server
};
window.weftView = report;

/** The session is what the server said, and what it has yet to be told. */
const session = {
    socket: null,
    hello: null,
    camera: null,       // null until hello, and once the socket has closed: nothing moves then
    home: null,         // the camera that R goes back to
    settings: null,
    pending: {},        // settings to send
    changed: false,     // the camera is to be sent
    toldMoving: false,  // the last camera message said that more follow
    ticking: false,
    centreOn: null,     // the pixel of a double click whose point becomes the orbit's centre
    pickedPixel: null,
};

/** The gesture is what pointers and the wheel are doing now. */
const gesture = {
    pointers: new Map(),
    mode: '',
    start: null,
    slop: 0,
    moved: false,
    lastClick: null,
    wheelTimer: 0,
};

/** The keys are those held down that move the camera, by KeyboardEvent.code. */
const keys = { held: new Set(), fast: false, time: 0 };

/** The area is the room for the picture, in CSS pixels. */
const area = { width: 1, height: 1 };

// ---------------------------------------------------------------------------------- vectors

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
const add = (a, b) => a.map((value, i) => value + b[i]);
const subtract = (a, b) => a.map((value, i) => value - b[i]);
const scale = (a, factor) => a.map((value) => value * factor);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const length = (a) => Math.hypot(...a);
const normalize = (a) => scale(a, 1 / length(a));
const cross = (a, b) => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
];

/** Turns `a` about the unit vector `axis`, counterclockwise seen from its tip. */
function rotate(a, axis, angle) {
    const cosine = Math.cos(angle);
    const along = scale(axis, dot(axis, a) * (1 - cosine));
    return add(add(scale(a, cosine), scale(cross(axis, a), Math.sin(angle))), along);
}

/** Finds some unit vector at right angles to the unit vector `a`. */
function perpendicular(a) {
    const other = Math.abs(a[0]) < 0.5 ? [1, 0, 0] : [0, 1, 0];
    return normalize(cross(a, other));
}

// ---------------------------------------------------------------------------------- cameras

const distanceOf = (camera) => length(subtract(camera.at, camera.from));
const sceneRadius = () => (session.hello.radius > 0 ? session.hello.radius : 1);

/** A camera is good when its numbers are finite and it looks somewhere. */
function isGoodCamera(camera) {
    const numbers = [...camera.from, ...camera.at, ...camera.up, camera.fov];
    return numbers.every(Number.isFinite) && distanceOf(camera) > 0 && length(camera.up) > 0;
}

/** The axes of the picture are the camera's directions in world space. */
function axesOf(camera) {
    const forward = normalize(subtract(camera.at, camera.from));
    const side = cross(forward, normalize(camera.up));
    const right = length(side) > 1e-9 ? normalize(side) : perpendicular(forward);
    return { right, up: cross(right, forward), forward };
}

/** The pole angle is that between `axis` and the direction from `at` to the camera. */
function poleAngle(camera, axis) {
    const outward = normalize(subtract(camera.from, camera.at));
    return Math.acos(clamp(dot(outward, axis), -1, 1));
}

/**
 * The orbit's axis is the camera's `up`. Where that leans with the view and the picture is level
 * all the same, it is the world's axis instead, so that orbits keep the horizon level.
 */
function orbitAxis(camera) {
    const given = normalize(camera.up);
    if (given.some((value) => Math.abs(value) > LEVEL_COSINE)) return given;
    const seen = axesOf(camera).up;
    const isLevel = (axis) => dot(axesOf({ ...camera, up: axis }).up, seen) > LEVEL_COSINE;
    return [[0, 1, 0], [0, 0, 1]].find(isLevel) ?? given;
}

/** Orbits about `at`: `turn` goes to the right, `tilt` goes down, both in radians. */
function orbited(camera, turn, tilt) {
    const up = orbitAxis(camera);
    const angle = poleAngle(camera, up);
    const wanted = clamp(angle + tilt, POLE_GAP, Math.PI - POLE_GAP);
    const { right } = axesOf({ ...camera, up });
    const tilted = rotate(subtract(camera.from, camera.at), right, wanted - angle);
    return { ...camera, from: add(camera.at, rotate(tilted, up, turn)), up };
}

/** Moves the camera and what it looks at by [right, up, forward] in world units. */
function shifted(camera, [x, y, z]) {
    const { right, up, forward } = axesOf(camera);
    const by = add(add(scale(right, x), scale(up, y)), scale(forward, z));
    return { ...camera, from: add(camera.from, by), at: add(camera.at, by) };
}

/** Changes the distance to `at` by `factor`, within what makes sense for the scene. */
function dollied(camera, factor) {
    const distance = distanceOf(camera);
    const nearest = Math.min(distance, 1e-3 * sceneRadius());
    const farthest = Math.max(distance, 100 * sceneRadius());
    const wanted = clamp(distance * factor, nearest, farthest);
    const outward = normalize(subtract(camera.from, camera.at));
    return { ...camera, from: add(camera.at, scale(outward, wanted)) };
}

/** Makes `at` the orbit's centre; `from` stays, unless the view would go along `up`. */
function centred(camera, at) {
    const next = { ...camera, at, up: orbitAxis(camera) };
    const angle = poleAngle(next, next.up);
    const nearPole = angle < POLE_GAP || angle > Math.PI - POLE_GAP;
    return nearPole ? orbited(next, 0, 0) : next;
}

/** Moves an `at` too near or too far to orbit about along the view, to the scene's middle. */
function withSensibleCentre(camera) {
    const radius = sceneRadius();
    const distance = distanceOf(camera);
    if (distance > 0.05 * radius && distance < 20 * radius) return camera;
    const { forward } = axesOf(camera);
    const depth = dot(subtract(session.hello.centre, camera.from), forward);
    const wanted = depth > 0.05 * radius ? depth : radius;
    return { ...camera, at: add(camera.from, scale(forward, wanted)) };
}

/** The world's size of the picture's height, at the distance of `at`. */
function visibleHeight(camera) {
    if (camera.orthographic) return 2 * sceneRadius();
    return 2 * distanceOf(camera) * Math.tan((camera.fov * Math.PI) / 360);
}

// ------------------------------------------------------------------------------- connection

/** Opens the session with the key in the page's address. */
function connect() {
    const token = location.hash.slice(1);
    if (!/^[0-9a-f]{32}$/i.test(token)) {
        showCover('Open the link that weft view printed; it has a key after #.', false);
        return;
    }
    showCover('Connecting…', false);
    const socket = new WebSocket(`ws://${location.host}/ws`);
    socket.binaryType = 'arraybuffer';
    session.socket = socket;
    socket.onopen = () => send(socket, { token });
    socket.onmessage = (event) => receive(socket, event.data);
    socket.onclose = (event) => {
        if (socket === session.socket) endSession(event.reason);
    };
}

/** Starts again, since the key in the page's address is another one. */
function reconnect() {
    const old = session.socket;
    endSession('the key changed');
    session.socket = null;
    old?.close();
    connect();
}

/** Shows that the socket has closed, and stops all motion. */
function endSession(reason) {
    const silent = session.camera ? 'the connection was lost' : 'weft view does not answer';
    stopMotion();
    timeline.playing = false;
    session.camera = null;
    session.pending = {};
    enableControls(false);
    setCommand('');
    showCover(`The view has ended: ${reason || silent}`, true);
}

/** Sends a message as JSON, where `socket` is still the session's open one. */
function send(socket, message) {
    if (socket !== session.socket || socket?.readyState !== WebSocket.OPEN) return;
    socket.send(JSON.stringify(message));
    report.sent += 1;
}

/** Takes in what the server sent: a frame, or a text message with one key. */
function receive(socket, data) {
    if (socket !== session.socket) return;
    if (data instanceof ArrayBuffer) {
        receiveFrame(socket, data);
        return;
    }
    for (const [name, value] of Object.entries(JSON.parse(data))) receivers.get(name)?.(value);
}

const receivers = new Map([
    ['hello', receiveHello],
    ['camera', receiveCamera],
    ['status', receiveStatus],
    ['picked', receivePicked],
    ['scene', (scene) => receiveScene(scene)],
    ['trust', (trust) => receiveTrust(trust)],
    ['front', (front) => showFront(front)],
    ['saved', (path) => showMessage(`Saved ${path}`, 'notice')],
    ['error', (text) => showMessage(text, 'error')],
]);

/** Begins the session: counts start anew, and controls show the server's choices. */
function receiveHello(hello) {
    session.hello = hello;
    session.settings = { ...hello.settings };
    session.pickedPixel = null;
    Object.assign(report, {
        state: 0, pictureState: 0, lastFrame: null, lastFrameB: null, status: null,
    });
    forgetPanes();
    forgetEditing();
    receiveCamera(hello.camera);
    session.home = session.camera;
    showHello();
    showTrust({ samples: 0, panes: [] });
    showFront({ done: 0, running: false, floor: null, points: [] });
    placeMarker();
    enableControls(true);
    showCover('Waiting for the first picture…', false);
}

/** Takes the server's camera as the one to move from. */
function receiveCamera(camera) {
    stopMotion();
    session.camera = withSensibleCentre(camera);
}

/** Shows the status; its size and command count only when it knows all that the page sent. */
function receiveStatus(status) {
    report.status = status;
    const current = status.state >= report.state && Object.keys(session.pending).length === 0;
    if (current) takeSettings(status.settings);
    setCommand(current ? status.command : '');
    setCommandB(current ? status.command_b : '');
    showOverlays(status.overlays);
    showRecords(status.records);
    showHistory(status);
    showFigures();
    showStages(status.stages);
}

/** Shows a picked pixel, and orbits about its point where a double click asked for it. */
function receivePicked(picked) {
    showPicked(picked);
    const asked = session.centreOn;
    if (!asked || asked[0] !== picked.at[0] || asked[1] !== picked.at[1]) return;
    session.centreOn = null;
    if (picked.point && session.camera) moveTo(centred(session.camera, picked.point));
}

// ----------------------------------------------------------------------------------- frames

/** Reads a frame's header; null when it is not a frame. */
function parseFrame(buffer) {
    if (buffer.byteLength < FRAME_HEADER) return null;
    const header = new DataView(buffer);
    const type = FRAME_TYPES[header.getUint8(4)];
    if (header.getUint32(0, true) !== FRAME_MAGIC || !type) return null;
    const flags = header.getUint16(6, true);
    return {
        seq: header.getUint32(8, true),
        state: header.getUint32(12, true),
        width: header.getUint16(16, true),
        height: header.getUint16(18, true),
        pane: header.getUint8(5),
        samples: header.getUint32(20, true),
        moving: (flags & MOVING) !== 0,
        final: (flags & FINAL) !== 0,
        image: new Blob([new Uint8Array(buffer, FRAME_HEADER)], { type }),
    };
}

/** Draws a frame unless a later one was faster, then tells the server that it is done. */
async function receiveFrame(socket, buffer) {
    const frame = parseFrame(buffer);
    if (!frame) {
        showMessage('The server sent a frame that this page cannot read.', 'error');
        return;
    }
    try {
        const bitmap = await createImageBitmap(frame.image, { colorSpaceConversion: 'none' });
        const last = frame.pane === 0 ? report.lastFrame : report.lastFrameB;
        const isNewer = !last || frame.seq > last.seq;
        if (isNewer && socket === session.socket) drawFrame(frame, bitmap);
        bitmap.close();
    } catch (error) {
        showMessage(`A frame could not be shown: ${error.message}`, 'error');
    }
    send(socket, { ack: frame.seq });
}

/** Takes a frame in, and puts what there is now on the canvas. */
function drawFrame(frame, bitmap) {
    keepPane(frame, bitmap);
    const { image, ...shown } = frame;
    if (frame.pane === 0) report.lastFrame = shown;
    else report.lastFrameB = shown;
    report.frames += 1;
    if (!report.lastFrame) return;
    drawPanes();
    hideCover();
    layOut();
    showFigures();
}

/** The shape on screen is the full size's; a frame from before a change of size keeps its own. */
function shownShape(frame) {
    const [width, height] = session.settings.size;
    const ratio = (frame.width * height) / (frame.height * width);
    return Math.abs(Math.log(ratio)) < 0.1 ? [width, height] : [frame.width, frame.height];
}

/** Makes the picture as large as fits, with sharp pixels where they are large and at rest. */
function layOut() {
    const frame = report.lastFrame;
    if (!frame) return;
    const [width, height] = shownShape(frame);
    const zoom = Math.min(area.width / width, area.height / height);
    canvas.style.width = `${Math.max(1, Math.floor(width * zoom))}px`;
    canvas.style.height = `${Math.max(1, Math.floor(height * zoom))}px`;
    const pixelSize = (width * zoom) / frame.width;
    canvas.classList.toggle('pixelated', !frame.moving && pixelSize > 2);
    placeMarker();
    placeDivider();
}

/** Finds the pixel of the full-size picture under the pointer; null beside the picture. */
function pixelAt(event) {
    const box = canvas.getBoundingClientRect();
    const [width, height] = session.settings.size;
    const x = Math.floor(((event.clientX - box.left) / box.width) * width);
    const y = Math.floor(((event.clientY - box.top) / box.height) * height);
    return x >= 0 && y >= 0 && x < width && y < height ? [x, y] : null;
}

/** Puts the marker on the picked pixel; it is hidden when the view is another. */
function placeMarker() {
    const pixel = session.pickedPixel;
    const marker = byId('marker');
    marker.hidden = !pixel;
    if (!pixel) return;
    const [width, height] = session.settings.size;
    const x = canvas.offsetLeft + ((pixel[0] + 0.5) / width) * canvas.offsetWidth;
    const y = canvas.offsetTop + ((pixel[1] + 0.5) / height) * canvas.offsetHeight;
    marker.style.left = `${x}px`;
    marker.style.top = `${y}px`;
}

// ----------------------------------------------------------------------------------- motion

/** Asks for the next animation frame, in which at most one camera is sent. */
function requestTick() {
    if (session.ticking) return;
    session.ticking = true;
    requestAnimationFrame(tick);
}

/** Does an animation frame's work: keys move the camera, then the server is told. */
function tick(now) {
    session.ticking = false;
    if (!session.camera) return;
    if (keys.held.size > 0) {
        moveByKeys([...keys.held], clamp((now - keys.time) / 1000, 0, LONGEST_STEP));
        keys.time = now;
    }
    playTimeline(now);
    sendChanges();
    if (keys.held.size > 0 || timeline.playing) requestTick();
}

/** Motion goes on while a drag lasts, keys are held or the wheel has just turned. */
function isMoving() {
    const dragging = gesture.moved && gesture.pointers.size > 0 && gesture.mode !== 'object';
    return dragging || keys.held.size > 0 || gesture.wheelTimer !== 0;
}

/** Forgets motion that goes on: another camera takes its place. */
function stopMotion() {
    clearTimeout(gesture.wheelTimer);
    gesture.wheelTimer = 0;
    gesture.pointers.clear();
    gesture.moved = false;
    viewArea.classList.remove('dragged');
    keys.held.clear();
    session.changed = false;
    session.toldMoving = false;
    session.centreOn = null;
}

/** Takes a new camera; the next animation frame sends it. */
function moveTo(camera) {
    if (!isGoodCamera(camera)) return;
    session.camera = camera;
    session.changed = true;
    requestTick();
}

/**
 * Counts the state up; where pictures change, what was known of the ones before is void, and so is
 * their judgement, unless only their colours on screen change.
 */
function nextState(changesPictures = true, changesErrors = changesPictures) {
    report.state += 1;
    if (!changesPictures) return report.state;
    report.pictureState = report.state;
    session.pickedPixel = null;
    placeMarker();
    setCommand('');
    setCommandB('');
    if (changesErrors) forgetJudgement();
    return report.state;
}

/** Sends the camera if it changed, or if the motion that was told of has ended. */
function sendCamera() {
    const moving = isMoving();
    const ended = session.toldMoving && !moving;
    if (!session.changed && !ended) return;
    const { from, at, up, fov } = session.camera;
    send(session.socket, { camera: { from, at, up, fov }, state: nextState(), moving });
    session.changed = false;
    session.toldMoving = moving;
    byId('camera').value = '';
}

/** Sends the settings that changed since the last animation frame, in one message. */
function sendSettings() {
    if (Object.keys(session.pending).length === 0) return;
    const changed = Object.keys(session.pending).filter((key) => !PICTURE_STAYS.has(key));
    // Two pictures are rendered again even for other colours.
    const recolours = !comparison() && changed.every((key) => RECOLOURS.has(key));
    const state = nextState(changed.length > 0, changed.length > 0 && !recolours);
    const message = { set: session.pending, state };
    if ('frame' in session.pending) message.moving = timeline.moving;
    send(session.socket, message);
    session.pending = {};
}

/** Sends the changes that wait for the next animation frame. */
function sendChanges() {
    sendSettings();
    sendEdits();
    sendCamera();
}

/** Sends a request at once, after the changes that were made before it. */
function request(message) {
    sendChanges();
    send(session.socket, message);
}

/** Changes settings; the next animation frame sends them. */
function change(settings) {
    if (!session.camera) return;
    Object.assign(session.settings, settings);
    Object.assign(session.pending, settings);
    requestTick();
}

/** Goes back to the camera that the session began with. */
function resetView() {
    if (!session.camera) return;
    stopMotion();
    moveTo(session.home);
}

/** Goes to a camera of the scene; the server answers with where it is. */
function jumpTo(name) {
    if (!session.camera || name === '') return;
    stopMotion();
    session.pending.camera = name;
    requestTick();
}

/** Orbits by a drag's pixels: a picture's height is a full turn. */
function dragOrbit([x, y]) {
    const rate = (2 * Math.PI) / canvas.clientHeight;
    moveTo(orbited(session.camera, -x * rate, -y * rate));
}

/** Pans by a drag's pixels: what lies at the distance of `at` follows the pointer. */
function dragPan([x, y]) {
    const rate = visibleHeight(session.camera) / canvas.clientHeight;
    moveTo(shifted(session.camera, [-x * rate, y * rate, 0]));
}

/** Goes nearer to `at` or away from it, which changes nothing for parallel rays. */
function dolly(factor) {
    if (session.camera.orthographic || factor === 1) return;
    moveTo(dollied(session.camera, factor));
}

// --------------------------------------------------------------------------------- pointers

const between = (a, b) => [b[0] - a[0], b[1] - a[1]];
const midpoint = (a, b) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
const pixelsBetween = (a, b) => Math.hypot(...between(a, b));
const placeOf = (event) => [event.clientX, event.clientY];

/** The button and the keys with it say what a drag does. */
function dragMode(event) {
    if (editing.drags && event.button === 0) return 'object';
    if (event.pointerType === 'touch') return 'orbit';
    if (event.button === 1) return 'dolly';
    const pans = event.button === 2 || event.shiftKey || event.ctrlKey || event.metaKey;
    return pans ? 'pan' : 'orbit';
}

function onPointerDown(event) {
    if (!session.camera || !report.lastFrame || gesture.pointers.size === 2) return;
    canvas.focus({ preventScroll: true });
    if (gesture.pointers.size === 0) {
        gesture.mode = dragMode(event);
        gesture.start = placeOf(event);
        gesture.slop = event.pointerType === 'touch' ? TOUCH_SLOP : MOUSE_SLOP;
        gesture.moved = false;
    } else {
        // Two fingers move the view, even where one moves an object.
        if (gesture.mode === 'object') endObjectDrag();
        gesture.mode = 'orbit';
        gesture.moved = true;
    }
    gesture.pointers.set(event.pointerId, placeOf(event));
    viewArea.setPointerCapture(event.pointerId);
}

function onPointerMove(event) {
    const last = gesture.pointers.get(event.pointerId);
    if (!last) return;
    const place = placeOf(event);
    if (!gesture.moved && pixelsBetween(gesture.start, place) <= gesture.slop) return;
    gesture.moved = true;
    viewArea.classList.add('dragged');
    const before = [...gesture.pointers.values()];
    gesture.pointers.set(event.pointerId, place);
    if (before.length === 1) dragOne(between(last, place));
    else dragTwo(before, [...gesture.pointers.values()]);
}

function onPointerEnd(event) {
    if (!gesture.pointers.delete(event.pointerId) || gesture.pointers.size > 0) return;
    const clicks = gesture.mode === 'orbit' || gesture.mode === 'object';
    const isClick = event.type === 'pointerup' && !gesture.moved && clicks;
    if (gesture.moved && gesture.mode === 'object') endObjectDrag();
    gesture.moved = false;
    viewArea.classList.remove('dragged');
    if (isClick) click(event);
    requestTick();
}

/** Moves the camera by one pointer's drag. */
function dragOne(by) {
    if (gesture.mode === 'orbit') dragOrbit(by);
    else if (gesture.mode === 'pan') dragPan(by);
    else if (gesture.mode === 'object') dragObject(by);
    else dolly(Math.exp(by[1] * MIDDLE_DRAG_RATE));
}

/** Moves the camera by two fingers: their middle pans, their distance is a dolly. */
function dragTwo(before, after) {
    dragPan(between(midpoint(...before), midpoint(...after)));
    const spanBefore = pixelsBetween(...before);
    const spanAfter = pixelsBetween(...after);
    if (spanBefore > 0 && spanAfter > 0) dolly(spanBefore / spanAfter);
}

/** Asks for the values of a pixel; the second click of two orbits about its point. */
function click(event) {
    const isSecond = isSecondClick(event);
    gesture.lastClick = isSecond ? null : { time: event.timeStamp, place: placeOf(event) };
    const pixel = pixelAt(event);
    if (!pixel) return;
    if (isSecond) session.centreOn = pixel;
    request({ pick: pixel });
}

function isSecondClick(event) {
    const last = gesture.lastClick;
    if (!last || event.timeStamp - last.time > DOUBLE_CLICK.time) return false;
    return pixelsBetween(last.place, placeOf(event)) <= DOUBLE_CLICK.distance;
}

function onWheel(event) {
    event.preventDefault();
    if (!session.camera) return;
    const pinch = event.ctrlKey ? PINCH_WHEEL : 1;
    const pixels = event.deltaY * WHEEL_UNITS[event.deltaMode] * pinch;
    dolly(Math.exp(clamp(pixels, -WHEEL_LIMIT, WHEEL_LIMIT) * WHEEL_RATE));
    clearTimeout(gesture.wheelTimer);
    gesture.wheelTimer = setTimeout(() => {
        gesture.wheelTimer = 0;
        requestTick();
    }, WHEEL_REST);
}

// ------------------------------------------------------------------------------------- keys

/** The fly keys move the camera along [right, up, forward]. */
const FLY_KEYS = new Map([
    ['KeyW', [0, 0, 1]],
    ['KeyS', [0, 0, -1]],
    ['KeyA', [-1, 0, 0]],
    ['KeyD', [1, 0, 0]],
    ['KeyQ', [0, -1, 0]],
    ['KeyE', [0, 1, 0]],
]);

/** The turn keys orbit by [turn, tilt]. */
const TURN_KEYS = new Map([
    ['ArrowLeft', [-1, 0]],
    ['ArrowRight', [1, 0]],
    ['ArrowUp', [0, -1]],
    ['ArrowDown', [0, 1]],
]);

/** The command keys do something once, by KeyboardEvent.key in lower case. */
const COMMAND_KEYS = new Map([
    ['r', resetView],
    [' ', togglePause],
    ['h', toggleHelp],
    ['?', toggleHelp],
    ['c', copyCommand],
    ['p', () => save('png')],
    ['g', () => setDragging(!editing.drags)],
    ['o', () => nextOverlay()],
    ['b', () => toggleComparison()],
    ['t', () => toggleTrust()],
    [',', () => stepFrame(-1)],
    ['.', () => stepFrame(1)],
]);

const isMotionKey = (code) => FLY_KEYS.has(code) || TURN_KEYS.has(code);

/** Moves the camera as if the keys `codes` were held for `seconds`. */
function moveByKeys(codes, seconds) {
    const step = seconds * (keys.fast ? FAST : 1);
    const total = (map, zero) => codes.filter((code) => map.has(code))
        .reduce((sum, code) => add(sum, map.get(code)), zero);
    const fly = scale(total(FLY_KEYS, [0, 0, 0]), step * FLY_SPEED * sceneRadius());
    const [turn, tilt] = scale(total(TURN_KEYS, [0, 0]), step * TURN_SPEED);
    if (fly.some((value) => value !== 0)) moveTo(shifted(session.camera, fly));
    if (turn !== 0 || tilt !== 0) moveTo(orbited(session.camera, turn, tilt));
}

/** Tells whether the control with the focus needs this key for itself. */
function isTakenByControl(event) {
    const { target } = event;
    if (!(target instanceof Element)) return false;
    if (target.matches('select, textarea, input[type="number"]')) return true;
    if (target.matches('input[type="range"], [role="slider"]')) return TURN_KEYS.has(event.code);
    const isPressed = target.matches('button, summary, [role="button"]');
    return isPressed && (event.key === ' ' || event.key === 'Enter');
}

function onKeyDown(event) {
    keys.fast = event.shiftKey;
    const key = event.key.toLowerCase();
    if ((event.ctrlKey || event.metaKey) && !event.altKey && key === 's') {
        event.preventDefault();
        save('png');
        return;
    }
    if ((event.ctrlKey || event.metaKey) && key === 'z' && !isTakenByControl(event)) {
        event.preventDefault();
        undo('last');
        return;
    }
    if (event.ctrlKey || event.metaKey || event.altKey || isTakenByControl(event)) return;
    if (byId('help').open) {
        if (COMMAND_KEYS.get(key) === toggleHelp) toggleHelp();
    } else if (isMotionKey(event.code)) {
        event.preventDefault();
        if (!event.repeat) holdKey(event.code);
    } else if (COMMAND_KEYS.has(key)) {
        event.preventDefault();
        if (!event.repeat) COMMAND_KEYS.get(key)();
    }
}

/** Begins a key's motion with one step, so that a key released at once moves the camera too. */
function holdKey(code) {
    if (!session.camera) return;
    moveByKeys([code], FIRST_STEP);
    if (keys.held.size === 0) keys.time = performance.now();
    keys.held.add(code);
}

function onKeyUp(event) {
    keys.fast = event.shiftKey;
    // A Mac tells nothing of keys released while Command is down: they all go with it.
    if (event.key === 'Meta') releaseKeys();
    else if (keys.held.delete(event.code)) requestTick();
}

function releaseKeys() {
    if (keys.held.size === 0) return;
    keys.held.clear();
    requestTick();
}

// --------------------------------------------------------------------------------- controls

/** Fills a select with names and chooses one. */
function fillSelect(select, names, chosen) {
    select.replaceChildren(...names.map((name) => new Option(name, name)));
    select.value = chosen;
}

/** Shows the scene, the server's choices and the settings that it began with. */
function showHello() {
    const { hello, settings } = session;
    document.title = `${hello.scene} – weft view`;
    byId('scene').textContent = hello.scene;
    byId('scene').title = hello.scene;
    byId('version').textContent = `weft ${hello.version}`;
    fillSelect(byId('algorithm'), hello.algorithms, settings.algorithm);
    fillSelect(byId('quality'), hello.qualities, settings.quality);
    fillSelect(byId('tone'), hello.tones, settings.tone);
    fillSelect(byId('algorithm-b'), hello.algorithms, hello.algorithms[0]);
    fillSelect(byId('quality-b'), hello.qualities, settings.quality);
    fillCameras(hello.cameras);
    fillSizes(settings.size);
    fillSampleLimits(settings.samples);
    showExposure();
    showPause();
    showComparison();
    showFolder(hello.folder);
}

/** Fills the camera select; its first entry stands for a view that is none of them. */
function fillCameras(names) {
    const select = byId('camera');
    fillSelect(select, names, '');
    const free = new Option('Free view', '', true, true);
    free.disabled = true;
    select.prepend(free);
    select.value = '';
}

/** Offers numbers of samples that end an image, and the one that the server has. */
function fillSampleLimits(chosen) {
    const limits = [...new Set([...SAMPLE_LIMITS, chosen])].sort((a, b) => a - b);
    const name = (limit) => (limit === 0 ? 'Without end' : String(limit));
    byId('sample-limit').replaceChildren(...limits.map((limit) => new Option(name(limit), limit)));
    byId('sample-limit').value = String(chosen);
}

/** Brings the controls in step with what the server has: it may have refused what was asked for. */
function takeSettings(settings) {
    takeSize(settings.size);
    const isOtherComparison =
        JSON.stringify(settings.compare) !== JSON.stringify(session.settings.compare);
    session.settings = { ...settings };
    for (const name of ['algorithm', 'quality', 'tone']) setChoice(name, settings[name]);
    const [firstView] = byId('camera').options;
    const text = settings.placed ? 'Free view' : 'First view';
    if (firstView.text !== text) firstView.text = text;
    setChoice('camera', settings.placed ? '' : settings.camera);
    if (byId('sample-limit').value !== String(settings.samples)) fillSampleLimits(settings.samples);
    if (document.activeElement !== byId('exposure-number')) showExposure();
    showPause();
    showTimeline();
    if (isOtherComparison) showComparison();
    showTrustState();
}

/** Sets a select, and leaves it alone where it is right: someone may have opened it. */
function setChoice(id, value) {
    if (byId(id).value !== value) byId(id).value = value;
}

const sizeName = ([width, height]) => `${width} × ${height}`;
const sizeValue = ([width, height]) => `${width}x${height}`;
const sizeOption = (size) => new Option(sizeName(size), sizeValue(size));

/** Lists `sizes` without repeats, the small ones first. */
function sortedSizes(sizes) {
    const unique = new Map(sizes.map((size) => [sizeValue(size), size]));
    return [...unique.values()].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
}

/** Scales a size so that its longer side is `side`. */
function sizeWithSide([width, height], side) {
    const factor = side / Math.max(width, height);
    return [width, height].map((value) => Math.max(1, Math.round(value * factor)));
}

function sizeGroup(label, sizes) {
    const group = document.createElement('optgroup');
    group.label = label;
    group.append(...sortedSizes(sizes).map(sizeOption));
    return group;
}

/** Fills the size select: squares, and sizes of the shape that the session began with. */
function fillSizes(size) {
    const isSquare = size[0] === size[1];
    const squares = SIDES.map((side) => [side, side]);
    const shaped = [size, ...SIDES.map((side) => sizeWithSide(size, side))];
    const groups = isSquare
        ? [sizeGroup('Square', [size, ...squares])]
        : [sizeGroup('Shape of this view', shaped), sizeGroup('Square', squares)];
    byId('size').replaceChildren(...groups);
    byId('size').value = sizeValue(size);
}

/** Takes the server's size, which may be none of the page's own. */
function takeSize(size) {
    const value = sizeValue(size);
    if (value === sizeValue(session.settings.size)) return;
    session.settings.size = size;
    const select = byId('size');
    select.value = value;
    if (select.value !== value) {
        select.append(sizeOption(size));
        select.value = value;
    }
    layOut();
}

/** Enables the controls that need a session. */
function enableControls(enabled) {
    byId('controls').disabled = !enabled;
    const sections = ['edit', 'sampling', 'comparison', 'judging', 'costs', 'saving', 'timeline'];
    for (const id of sections) {
        byId(id).inert = !enabled;
    }
    byId('pause').disabled = !enabled;
}

/** Shows whether pictures can be saved, and where they go. */
function showFolder(folder) {
    const why = 'Nothing can be saved: weft view has no folder to save to.';
    byId('save-hint').textContent = folder ? `Saved to ${folder}` : why;
    for (const kind of ['png', 'exr', 'preset', 'edits']) {
        const button = byId(`save-${kind}`);
        button.disabled = !folder;
        button.title = folder ? '' : why;
    }
}

function showExposure() {
    const { exposure } = session.settings;
    for (const field of [byId('exposure'), byId('exposure-number')]) {
        if (field.value === '' || Number(field.value) !== exposure) field.value = exposure;
    }
}

/** Sets the exposure from a field's text; text that is no number changes nothing. */
function setExposure(text) {
    if (!session.camera) return;
    const stops = text === '' ? NaN : Number(text);
    if (Number.isFinite(stops)) {
        const rounded = Math.round(stops * 10) / 10;
        change({ exposure: clamp(rounded, -EXPOSURE_LIMIT, EXPOSURE_LIMIT) });
    }
    showExposure();
}

function showPause() {
    byId('pause').textContent = session.settings.paused ? 'Resume' : 'Pause';
}

function togglePause() {
    if (!session.camera) return;
    change({ paused: !session.settings.paused });
    showPause();
}

/** Asks the server to save the picture as a file of `kind`. */
function save(kind) {
    if (!session.camera) return;
    if (session.hello.folder) request({ save: kind });
    else showMessage(byId('save-hint').textContent, 'notice');
}

/** Shows the command; it stays untouched while it is the same, for a selection in it. */
function setCommand(command) {
    const field = byId('command');
    if (field.value !== command) field.value = command;
    byId('copy').disabled = command === '';
    byId('copy-a').disabled = command === '';
}

/** Copies a text, or says that it is selected where the browser does not let the page copy. */
async function copyText(text, field) {
    try {
        await navigator.clipboard.writeText(text);
        showMessage('The command is copied.', 'notice');
    } catch {
        setCollapsed(false);
        byId('saving').open = true;
        field.value = text;
        field.focus();
        field.select();
        showMessage('The command is selected: copy it with Ctrl+C.', 'notice');
    }
}

/** Copies the command, where there is one yet. */
function copyCommand() {
    const field = byId('command');
    if (field.value === '') showMessage('There is a command once the view is at rest.', 'notice');
    else copyText(field.value, field);
}

function toggleHelp() {
    const help = byId('help');
    if (help.open) {
        help.close();
        return;
    }
    releaseKeys();
    help.showModal();
}

/** Hides the controls for a larger picture, or shows them again. */
function setCollapsed(collapsed) {
    document.body.classList.toggle('collapsed', collapsed);
    byId('panel-body').hidden = collapsed;
    const button = byId('collapse');
    button.textContent = collapsed ? 'Show' : 'Hide';
    button.setAttribute('aria-expanded', String(!collapsed));
    button.setAttribute('aria-label', collapsed ? 'Show the controls' : 'Hide the controls');
}

// ---------------------------------------------------------------------------------- figures

const whole = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });
const oneDecimal = new Intl.NumberFormat('en', {
    minimumFractionDigits: 1,
    maximumFractionDigits: 1,
});
const figure = (format, value) => (Number.isFinite(value) ? format.format(value) : NOTHING);

/** Writes a linear value with four digits, or with an exponent where it is tiny or huge. */
function writeValue(value) {
    if (!Number.isFinite(value)) return NOTHING;
    const size = Math.abs(value);
    if (value === 0 || (size >= 1e-3 && size < 1e5)) return String(Number(value.toPrecision(4)));
    return value.toExponential(2);
}

/** Shows the phase, the samples and the speed. */
function showFigures() {
    const { status } = report;
    if (!status) return;
    const phase = PHASES[status.phase] ?? status.phase;
    const samples = figure(whole, status.samples);
    byId('phase').textContent = phase;
    byId('samples').textContent = samples;
    byId('sample-time').textContent = figure(oneDecimal, status.ms);
    byId('ray-rate').textContent = figure(oneDecimal, status.rays_per_second / 1e6);
    byId('summary').textContent = `${phase}, ${samples} ${samples === '1' ? 'sample' : 'samples'}`;
}

/** Keeps the longest stages, in the order that they came in. */
function longestStages(stages) {
    const timed = stages.filter((stage) => Number.isFinite(stage[1]));
    const longest = [...timed].sort((a, b) => b[1] - a[1]).slice(0, MOST_STAGES);
    return timed.filter((stage) => longest.includes(stage));
}

function makeSpan(className, text) {
    const element = document.createElement('span');
    element.className = className;
    element.textContent = text;
    return element;
}

function stageRow() {
    const row = document.createElement('li');
    const track = makeSpan('stage-track', '');
    track.append(makeSpan('stage-bar', ''));
    track.setAttribute('aria-hidden', 'true');
    row.append(makeSpan('stage-name', ''), track, makeSpan('stage-time', ''));
    return row;
}

/** Shows stages' times as bars; rows are used again, so that nothing flickers. */
function showStages(stages) {
    const list = byId('stages');
    const shown = longestStages(stages);
    const longest = Math.max(...shown.map((stage) => stage[1]), Number.MIN_VALUE);
    while (list.children.length > shown.length) list.lastElementChild.remove();
    while (list.children.length < shown.length) list.append(stageRow());
    shown.forEach(([name, time], i) => {
        const [label, track, value] = list.children[i].children;
        label.textContent = name;
        label.title = name;
        track.firstElementChild.style.width = `${(100 * time) / longest}%`;
        value.textContent = time.toFixed(time < 10 ? 2 : 1);
    });
    byId('stages-hint').hidden = shown.length > 0;
}

/** Makes a row of the inspector; a single value has the row to itself. */
function valueRow(name, values) {
    const row = document.createElement('tr');
    const head = document.createElement('th');
    head.scope = 'row';
    head.textContent = name;
    const cells = values.map((value) => {
        const cell = document.createElement('td');
        cell.textContent = typeof value === 'string' ? value : writeValue(value);
        if (values.length === 1) cell.colSpan = 3;
        return cell;
    });
    row.append(head, ...cells);
    return row;
}

/** Shows the values of a picked pixel, and marks it in the picture. */
function showPicked(picked) {
    const samples = figure(whole, picked.samples);
    byId('picked').textContent = `Pixel ${picked.at.join(', ')}; samples: ${samples}`;
    const rows = Object.entries(picked.values)
        .map(([name, values]) => valueRow(name || 'image', values));
    rows.push(valueRow('point', picked.point ?? ['no surface']));
    byId('value-rows').replaceChildren(...rows);
    byId('values').hidden = false;
    session.pickedPixel = picked.at;
    byId('inspector').open = true;
    offerEdits(picked);
    placeMarker();
}

// --------------------------------------------------------------------------------- messages

/** Shows a line over the picture; a notice goes by itself, an error stays. */
function showMessage(text, kind) {
    const list = byId('messages');
    [...list.children].find((line) => line.firstChild.textContent === text)?.remove();
    const line = document.createElement('div');
    line.className = `message ${kind}`;
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = 'Dismiss';
    button.onclick = () => line.remove();
    line.append(makeSpan('', text), button);
    list.append(line);
    if (list.children.length > MOST_MESSAGES) list.firstElementChild.remove();
    if (kind === 'notice') setTimeout(() => line.remove(), NOTICE_TIME);
}

/** Says in the picture's middle why there is none, or why it no longer changes. */
function showCover(text, canConnect) {
    byId('cover').hidden = false;
    byId('cover-text').textContent = text;
    byId('connect-again').hidden = !canConnect;
}

function hideCover() {
    byId('cover').hidden = true;
}
