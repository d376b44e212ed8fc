// The page: opens scenes, steps them, passes pointers on to the plants, and shows what each stage of a step costs.
"use strict";

const STEP = 1 / 60;
const STAGES = ["step", "collide", "effects", "assembly", "solve", "response", "capsules", "surface"];
const INTEGRATORS = ["implicit Euler", "BDF2", "SDIRK2", "TR-BDF2", "generalized alpha"];
const EFFECTS = ["gravity", "damping", "user force", "surface", "normals", "rigid contact", "friction", "two way", "plasticity",
    "plant contact", "self contact", "breaking", "wind", "air drag", "fibres"];
const OFF_AT_FIRST = ["self contact", "breaking"];
const SCENES = [{ plants: 1, wind: 0, far: 3.6, high: 1.1 }, { plants: 1, wind: 0, far: 4.2, high: 1.1 },
    { plants: 10, wind: 0, far: 5, high: 1.1 }, { plants: 100, wind: 6, far: 9, high: 1.4 }];
const element = id => document.getElementById(id);

// ?alone in the address: one thread although there could be more.
let threaded = self.crossOriginIsolated && !location.search.includes("alone");

let library, drawing, room;                    // room: memory of the library's for what it gives
let view = { turn: 0.6, tilt: 0.25, far: 3.6, high: 1.1 };
let held = null;                               // a pointer that pulls a plant: its distance along the axis of sight [m]
let looking = null, walking = { x: 0, z: 0 };
const page = { ready: false, errors: [], steps: 0 };

function tell(text) {
    page.errors.push(text);
    element("message").textContent = text;
}
addEventListener("error", event => tell(event.message));
addEventListener("unhandledrejection", event => tell(String(event.reason)));

function call(name, ...values) {
    const result = library["_garden_" + name](...values);
    if (library._garden_failed()) tell(name + ": " + library.UTF8ToString(library._garden_error()));
    return result;
}
const doubles = (at, count) => library.HEAPF64.slice(at / 8, at / 8 + count);
const words = (at, count) => library.HEAPU32.slice(at / 4, at / 4 + count);

async function takeModel(which, file) {
    const answer = await fetch(file);
    if (!answer.ok) throw new Error(file + " was not found");
    const bytes = new Uint8Array(await answer.arrayBuffer()), at = library._malloc(bytes.length);
    library.HEAPU8.set(bytes, at);
    const ms = call("take_model", which, at, bytes.length);
    library._free(at);
    return ms;
}

function surfaceOf(plant) {
    call("get_surface", plant, room);
    const [positions, normals, uvs, indices, vertices, triangles, colors] = words(room, 7);
    // Drawing takes no memory that threads share.
    const floats = (at, count) => !at ? null : threaded ? library.HEAPF32.slice(at / 4, at / 4 + count)
        : new Float32Array(library.HEAPF32.buffer, at, count);
    return { positions: floats(positions, 3 * vertices), normals: floats(normals, 3 * vertices), uvs: floats(uvs, 2 * vertices),
        colors: colors ? library.HEAPU8.slice(colors, colors + 4 * vertices) : null,
        indices: words(indices, 3 * triangles) };
}

async function readParts() {
    const parts = [], textures = {};
    for (let i = 0; i < call("get_part_count"); i++) {
        call("get_part", i, room, room + 16);
        const [first, count, texture] = library.HEAP32.slice(room / 4, room / 4 + 3);
        parts.push({ first, count, texture, color: library.HEAPF32.slice(room / 4 + 4, room / 4 + 8) });
        if (texture < 0 || textures[texture]) continue;
        call("get_texture", texture, room);
        const [at, size] = words(room, 2);
        const image = await createImageBitmap(new Blob([library.HEAPU8.slice(at, at + size)]));
        textures[texture] = drawing.makeTexture(image);
    }
    return { parts, textures };
}

function settings() {
    let effects = 0;
    EFFECTS.forEach((name, bit) => { if (element("effect" + bit).checked) effects |= 1 << bit; });
    return { mechanics: +element("mechanics").value, integrator: +element("integrator").value, effects, wind: +element("wind").value };
}

async function open(scene, plants = SCENES[scene].plants) {
    page.ready = false;
    const s = settings();
    page.plants = call("open", scene, s.mechanics, s.integrator, s.effects, s.wind, plants);
    const { parts, textures } = await readParts();
    drawing.setPlants(Array.from({ length: page.plants }, (_, i) => surfaceOf(i)), parts, textures);
    view = { turn: 0.6, tilt: 0.25, far: SCENES[scene].far, high: SCENES[scene].high };
    page.steps = 0;
    page.ready = true;
}

// ---- camera ------------------------------------------------------------------------------------------------------------

function camera() {
    const near = 0.05, far = 100, aspect = drawing.canvas.clientWidth / drawing.canvas.clientHeight, f = 1 / Math.tan(0.35);
    const cos = Math.cos(view.tilt), back = [Math.sin(view.turn) * cos, Math.sin(view.tilt), Math.cos(view.turn) * cos];
    const eye = [view.far * back[0], view.high + view.far * back[1], view.far * back[2]];
    const right = [Math.cos(view.turn), 0, -Math.sin(view.turn)];
    const up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2], back[0] * right[1] - back[1] * right[0]];
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2], a = (far + near) / (near - far), b = 2 * far * near / (near - far);
    const x = right.map(v => v * f / aspect), y = up.map(v => v * f);
    const matrix = new Float32Array(16);
    for (let i = 0; i < 3; i++) matrix.set([x[i], y[i], a * back[i], -back[i]], 4 * i);
    matrix.set([-dot(x, eye), -dot(y, eye), -a * dot(back, eye) + b, dot(back, eye)], 12);
    return { matrix, eye, right, up, back, f, aspect };
}
// The direction from the eye through a pixel, one metre along the axis of sight.
function rayThrough(px, py) {
    const c = camera(), canvas = drawing.canvas;
    const x = (2 * px / canvas.clientWidth - 1) * c.aspect / c.f, y = (1 - 2 * py / canvas.clientHeight) / c.f;
    return { eye: c.eye, direction: [0, 1, 2].map(i => x * c.right[i] + y * c.up[i] - c.back[i]) };
}

// ---- what people do ----------------------------------------------------------------------------------------------------

function press(event) {
    const { eye, direction } = rayThrough(event.offsetX, event.offsetY), length = Math.hypot(...direction);
    const distance = call("take", ...eye, ...direction);
    if (distance >= 0) held = { pointer: event.pointerId, along: distance / length };
    else looking = { pointer: event.pointerId, x: event.offsetX, y: event.offsetY };
}
function move(event) {
    if (held && held.pointer === event.pointerId) {
        const { eye, direction } = rayThrough(event.offsetX, event.offsetY);
        call("pull", ...[0, 1, 2].map(i => eye[i] + held.along * direction[i]));
    } else if (looking && looking.pointer === event.pointerId) {
        view.turn -= 0.008 * (event.offsetX - looking.x);
        view.tilt = Math.min(1.4, Math.max(0.02, view.tilt + 0.008 * (event.offsetY - looking.y)));
        Object.assign(looking, { x: event.offsetX, y: event.offsetY });
    }
}
function release(event) {
    if (held && held.pointer === event.pointerId) {
        call("let_go");
        held = null;
    }
    if (looking && looking.pointer === event.pointerId) looking = null;
}
function throwBall() {
    const { eye, back } = camera();
    call("throw", ...eye, ...back.map((v, i) => -8 * v + (i === 1 ? 1 : 0)));
}
function key(event, speed) {
    const way = { ArrowLeft: ["x", -1], ArrowRight: ["x", 1], ArrowUp: ["z", -1], ArrowDown: ["z", 1] }[event.key];
    if (way) walking[way[0]] = way[1] * speed;
}

function makeForm() {
    element("integrator").innerHTML = INTEGRATORS.map((name, i) => `<option value="${i}"${i === 1 ? " selected" : ""}>${name}`).join("");
    element("effects").innerHTML = EFFECTS.map((name, bit) =>
        `<label><input type="checkbox" id="effect${bit}"${OFF_AT_FIRST.includes(name) ? "" : " checked"}> ${name}</label>`).join("");
    const on = (id, what, run) => element(id).addEventListener(what, run);
    on("scene", "change", () => {
        const scene = element("scene").selectedIndex;
        element("wind").value = SCENES[scene].wind;
        showWind();
        open(scene);
    });
    on("mechanics", "change", () => call("set_mechanics", settings().mechanics));
    on("integrator", "change", () => call("set_integrator", settings().integrator));
    on("effects", "change", () => call("set_effects", settings().effects));
    on("wind", "input", () => { showWind(); call("set_wind", settings().wind); });
    on("throw", "click", throwBall);
    on("measure", "click", async () => { element("result").textContent = describe(await measure()); });
    on("view", "pointerdown", press);
    on("view", "pointermove", move);
    on("view", "pointerup", release);
    on("view", "pointercancel", release);
    on("view", "wheel", event => { view.far = Math.min(30, Math.max(0.5, view.far * Math.exp(0.001 * event.deltaY))); });
    addEventListener("keydown", event => key(event, 1));
    addEventListener("keyup", event => key(event, 0));
}
function showWind() {
    element("speed").textContent = element("wind").value + " m/s";
}

// ---- measuring ---------------------------------------------------------------------------------------------------------

// The least times of a step without drawing [ms]: 300 corn plants as rods in wind, those of the field (41 capsules each) and
// whole ones (165), and one corn in its cage.
async function measure(steps = 120) {
    page.ready = false;
    const time = (scene, mechanics, wind, plants) => {
        const s = settings();
        call("open", scene, mechanics, s.integrator, s.effects & ~(3 << 3), wind, plants);
        const times = [];
        for (let i = 0; i < steps; i++) {
            const start = performance.now();
            call("step", STEP);
            times.push(performance.now() - start);
        }
        return Math.min(...times.slice(steps / 4));
    };
    const result = { field: time(3, 3, 6, 300), whole: time(0, 3, 6, 300), cage: time(0, 1, 6, 1) };
    await open(element("scene").selectedIndex);
    return result;
}
const describe = r => `300 corn plants as rods in wind: ${r.field.toFixed(1)} ms a step; of 165 capsules each: ${r.whole.toFixed(1)} ms; `
    + `one in its cage: ${r.cage.toFixed(2)} ms`;

// ---- frames ------------------------------------------------------------------------------------------------------------

let owed = 0, last = 0, shown = 0;
function frame(now) {
    requestAnimationFrame(frame);
    if (!page.ready) return;
    owed = Math.min(owed + Math.min((now - last) / 1000, 0.1), 3 * STEP);
    last = now;
    while (owed >= STEP) {
        if (walking.x || walking.z) call("walk", walking.x * STEP, walking.z * STEP, STEP);
        call("step", STEP);
        page.steps++;
        owed -= STEP;
    }
    for (let i = 0; i < page.plants; i++) {
        const surface = surfaceOf(i);
        drawing.movePlant(i, surface.positions, surface.normals);
    }
    const balls = [];
    for (let i = 0; i < call("get_ball_count"); i++) if (call("get_ball", i, room)) balls.push(doubles(room, 4));
    if (call("get_ball", -1, room)) {
        const [x, y, z, radius] = doubles(room, 4);
        for (let i = -2; i <= 2; i++) balls.push([x, y + 0.3 * i, z, radius]);
    }
    const c = camera();
    drawing.draw(c.matrix, c.eye, balls);
    if (now - shown < 250) return;
    shown = now;
    call("get_times", room);
    const times = doubles(room, STAGES.length);
    element("times").innerHTML = STAGES.map((name, i) => `<tr><td>${name}<td>${times[i].toFixed(2)} ms`).join("");
}

function loadScript(file) {
    return new Promise((loaded, failed) => {
        const script = Object.assign(document.createElement("script"), { src: file, onload: loaded, onerror: () => failed(new Error(file + " was not found")) });
        document.head.append(script);
    });
}

// With threads where the server isolates the page and the library for that is there.
async function begin() {
    if (threaded) threaded = await loadScript("threads/frond.js").then(() => true, () => false);
    if (!threaded) await loadScript("frond.js");
    library = await makeFrond();
    page.threads = threaded ? Math.min(navigator.hardwareConcurrency, 8) : 1;
    call("set_threads", page.threads);
    room = library._malloc(256);
    drawing = new Drawing(element("view"));
    page.loaded = [];
    for (const file of ["corn.frond", "cucumber.frond", "corn_field.frond"]) page.loaded.push(await takeModel(page.loaded.length, file));
    makeForm();
    showWind();
    await open(0);
    requestAnimationFrame(frame);
}
const begun = begin();
begun.catch(error => tell(String(error)));
