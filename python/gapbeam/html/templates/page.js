/* What one moves: way, slider, events, place along the beam, tables, theme. */

const byId = (id) => document.getElementById(id);
const view = { way: 0, stop: 0, place: 0, playing: null };
const scale = DATA.ways.some((way) => way.intervals && way.intervals.length) ? new Scale() : null;
const STOPS = 200, NOISE = 1e-12; // parts of the slider; share of the largest value that is nothing but rounding
const NEXT_TO_NOTHING = 1e-7; // share of the largest value that a place with five digits cannot tell from 0

/* The places of the slider: both ends of all intervals, so every event, and equal parts between. */
function stopsOf(way) {
  if (way.stops) return way.stops;
  if (!way.intervals) return (way.stops = Array.from({ length: 41 }, (_, i) => ({ at: i / 40 })));
  const total = way.intervals.reduce((sum, one) => sum + one.to - one.from, 0) || 1, stops = [];
  way.intervals.forEach((interval, k) => {
    const count = Math.max(1, Math.round((STOPS * (interval.to - interval.from)) / total)), before = way.intervals[k - 1];
    const joined = before && before.to === interval.from && before.nodes[before.nodes.length - 1] === interval.nodes[0];
    if (!joined) stops.push({ interval, at: interval.from });
    if (interval.to > interval.from) for (let i = 1; i <= count; i++) stops.push({ interval, at: i === count ? interval.to : interval.from + ((interval.to - interval.from) * i) / count });
  });
  way.stops = stops;
  for (const event of way.events) {
    let best = 0;
    stops.forEach((stop, i) => { if (Math.abs(stop.at - event.at) <= Math.abs(stops[best].at - event.at)) best = i; });
    event.stop = Math.abs(stops[best].at - event.at) <= 1e-9 * total ? best : -1; // -1: so many events that it is not drawn
  }
  return stops;
}

function stateNow() {
  const way = DATA.ways[view.way], stop = stopsOf(way)[view.stop];
  return stop.interval ? new State(way, stop.interval, stop.at) : null;
}

function capital(text) { return text.charAt(0).toUpperCase() + text.slice(1); }

/* The state in words, for the caption and for who listens. */
function inWords(state, events) {
  const way = DATA.ways[view.way], parts = [];
  if (way.title) parts.push(way.title);
  if (way.axis === "position") parts.push(`position ${withUnit("x", state.at)}`);
  else parts.push(`load factor ${number(state.factor)}${state.interval.leg === undefined ? "" : ` of leg ${state.interval.leg}`}`);
  const text = [`${capital(parts.join(", "))}.`];
  if (events.length) text.push(`${capital(events.map((one) => one.words).join("; "))}.`);
  const opened = state.supports.map((one, k) => [one.name, k]).filter(([, k]) => state.words[k] === "open");
  const [open, loose] = [false, true].map((turns) => opened.filter(([, k]) => Boolean(state.supports[k].turns) === turns));
  const listed = open.slice(0, 8).map(([name, k]) => `${name} (${withUnit("opening", state.opening[k])})`).join(", ");
  if (loose.length) text.push(`Turning freely: ${loose.slice(0, 8).map(([name]) => name).join(", ")}${loose.length > 8 ? ` and ${loose.length - 8} more` : ""}.`);
  if (state.supports.some((one) => one.side !== 0 && !one.turns)) text.push(open.length ? `Without contact: ${listed}${open.length > 8 ? ` and ${open.length - 8} more` : ""}.` : "All supports are in contact.");
  if (state.free.length) text.push(`${state.free.length} free span${state.free.length > 1 ? "s" : ""} above the ground.`);
  for (const name of ["moment", "deflection"]) {
    const [one, other] = state.extremes(name, scale.step), larger = Math.abs(one.value) >= Math.abs(other.value) ? one : other;
    text.push(`Largest ${name} ${withUnit(name, larger.value)} at x = ${number(larger.x)}.`);
  }
  return text.join(" ");
}

let speaking = null;
function say(text) { // not at every step while it plays
  byId("caption").textContent = text;
  clearTimeout(speaking);
  speaking = setTimeout(() => { byId("spoken").textContent = text; }, 350);
}

function show() {
  const way = DATA.ways[view.way], state = stateNow(), svg = byId("picture");
  const slider = byId("slider"), stops = stopsOf(way);
  slider.value = view.stop;
  if (!state) {
    const share = stops[view.stop].at;
    svg.setAttribute("viewBox", `0 0 ${WIDTH} 220`);
    svg.innerHTML = drawMotion(way, share, 100);
    byId("now").textContent = way.motion.length ? way.moves : "";
    say(`${capital(way.title)}: ${way.reason}.`);
    slider.setAttribute("aria-valuetext", `${way.moves ?? "free motion"}, ${Math.round(100 * share)} %`);
    byId("place-row").hidden = true;
    return;
  }
  const here = way.events.filter((one) => one.stop === view.stop);
  const { svg: parts, height } = picture(state, scale, new Set(here.map((one) => one.support)));
  svg.setAttribute("viewBox", `0 0 ${WIDTH} ${height}`);
  svg.innerHTML = `<title id="picture-title">Beam, deflection, moment and shear</title>${parts}`;
  const text = inWords(state, here);
  svg.setAttribute("aria-label", text);
  const now = way.axis === "position" ? `position ${withUnit("x", state.at)}` : `load factor ${number(state.factor)}`;
  byId("now").textContent = now;
  byId("now").dataset.value = way.axis === "position" ? state.at : state.factor;
  slider.setAttribute("aria-valuetext", now + (here.length ? `: ${here.map((one) => one.words).join("; ")}` : ""));
  document.querySelectorAll(".mark").forEach((mark) => mark.classList.toggle("here", way.events[Number(mark.dataset.event)].stop === view.stop));
  say(text);
  fillSupports(state);
  byId("place-row").hidden = false;
  showPlace(state);
}

/* The row of values at one place along the beam. */
function showPlace(state) {
  const x = view.place * scale.end, at = scale.x(x), height = byId("picture").viewBox.baseVal.height;
  byId("cursor").innerHTML = line(at, 8, at, height - 6, "cursor");
  byId("place").value = Math.round(view.place * 1000);
  byId("place").setAttribute("aria-valuetext", `x = ${withUnit("x", x)}`);
  const cells = [`<span>x = <output data-field="x" data-value="${x}">${withUnit("x", x)}</output></span>`];
  for (const { name, words: title } of DATA.panels) {
    if (name === "axial_force" && !state.n) continue;
    const left = state.value(name, x, true), right = state.value(name, x), largest = Math.max(...scale.ranges[name].map(Math.abs));
    const told = (value) => (Math.abs(value) <= NEXT_TO_NOTHING * largest ? 0 : value), jumps = Math.abs(left - right) > 1e-9 * largest;
    const text = jumps ? `${shown(name, told(left))} | ${withUnit(name, told(right))}` : withUnit(name, told(right));
    cells.push(`<span>${title} <output data-field="${name}" data-value="${right}" data-left="${left}">${text}</output></span>`);
  }
  byId("readout").innerHTML = cells.join("");
}

/* Numbers of the state in the table of supports. */
function fillSupports(state) {
  const table = byId("supports");
  if (!table) return;
  const heads = Array.from(table.querySelectorAll("th"), (one) => one.dataset.of);
  table.querySelectorAll("tbody tr").forEach((row) => {
    const k = Number(row.dataset.row);
    heads.forEach((of, i) => {
      const cell = row.children[i];
      if (of === "state") {
        cell.textContent = `${state.words[k] === "open" ? "\u25cb" : state.words[k] === "bilateral" ? "\u25b2" : "\u25cf"} ${DATA.said[DATA.words.indexOf(state.words[k])]}`;
      } else if (DATA.units[of] && of !== "x") {
        const value = state[of] ? state[of][k] : 0, largest = Math.max(0, ...(state[of] || []).map(Math.abs));
        cell.textContent = shown(of, Math.abs(value) <= NOISE * largest ? 0 : value);
        cell.dataset.value = value;
      }
    });
  });
}

function goTo(stop) {
  view.stop = Math.min(Math.max(stop, 0), stopsOf(DATA.ways[view.way]).length - 1);
  show();
}

/* Another way: its slider, its marks; at the end of the load, trains at their beginning. */
function choose(k, stop = null) {
  const way = DATA.ways[view.way = k], stops = stopsOf(way), slider = byId("slider");
  byId("ways").value = k;
  slider.max = stops.length - 1;
  const single = stops.length < 2;
  document.querySelectorAll(".slides").forEach((one) => { one.hidden = single && (one.id !== "play" || DATA.ways.length < 2); });
  byId("marks").innerHTML = (way.events || []).map((one, i) => one.stop < 0 ? "" : `<button type="button" class="mark" data-event="${i}" tabindex="-1" style="left:${(100 * one.stop) / Math.max(1, stops.length - 1)}%" title="${escaped(`${way.axis} ${number(one.factor ?? one.at)}: ${one.words}`)}" aria-label="${escaped(one.words)}"></button>`).join("");
  goTo(stop ?? (way.intervals ? (way.axis === "position" ? Math.floor(stops.length / 2) : stops.length - 1) : Math.floor(stops.length / 2)));
}

function nextEvent(sign) {
  const way = DATA.ways[view.way];
  const places = [0, ...(way.events || []).map((one) => one.stop).filter((one) => one >= 0), stopsOf(way).length - 1].sort((a, b) => a - b);
  const there = sign > 0 ? places.find((one) => one > view.stop) : places.reverse().find((one) => one < view.stop);
  if (there !== undefined) goTo(there);
}

/* Play: along the slider, or through the combinations where each has one state. */
function play() {
  const button = byId("play");
  if (view.playing) {
    clearInterval(view.playing);
    view.playing = null;
  } else {
    const back = DATA.ways[view.way].left, count = stopsOf(DATA.ways[view.way]).length, single = count < 2;
    if (!single && view.stop === (back ? 0 : count - 1)) goTo(back ? count - 1 : 0);
    view.playing = setInterval(() => {
      if (single) choose((view.way + 1) % DATA.ways.length);
      else if (view.stop === (back ? 0 : count - 1)) play();
      else goTo(view.stop + (back ? -1 : 1));
    }, single ? 900 : 40);
  }
  button.textContent = view.playing ? "\u25a0 Stop" : "\u25b6 Play";
  button.setAttribute("aria-pressed", String(Boolean(view.playing)));
}

/* Sort a table by a column; numbers by their values, once more: the other way round. */
function sort(button) {
  const head = button.closest("th"), table = head.closest("table"), column = Array.from(head.parentNode.children).indexOf(head);
  const down = head.getAttribute("aria-sort") === "ascending", body = table.tBodies[0], rows = Array.from(body.rows);
  const key = (row) => { const value = row.cells[column].dataset.value; return value ? Number(value) : null; };
  rows.sort((one, other) => {
    const [a, b] = [key(one), key(other)];
    const order = a !== null && b !== null ? a - b : a !== null ? -1 : b !== null ? 1 : one.cells[column].textContent.localeCompare(other.cells[column].textContent, undefined, { numeric: true });
    return down ? -order : order;
  });
  body.append(...rows);
  table.querySelectorAll("th").forEach((one) => one.setAttribute("aria-sort", one === head ? (down ? "descending" : "ascending") : "none"));
}

function theme() {
  const root = document.documentElement, dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = dark ? "light" : "dark";
  byId("theme").setAttribute("aria-pressed", String(!dark));
}

function pointTo(event) {
  const svg = byId("picture"), box = svg.getBoundingClientRect(), x = ((event.clientX - box.left) / box.width) * WIDTH;
  view.place = Math.min(Math.max((x - LEFT) / (WIDTH - LEFT - RIGHT), 0), 1);
  const state = stateNow();
  if (state) showPlace(state);
}

byId("ways").addEventListener("change", (event) => choose(Number(event.target.value)));
byId("slider").addEventListener("input", (event) => goTo(Number(event.target.value)));
byId("place").addEventListener("input", (event) => { view.place = Number(event.target.value) / 1000; showPlace(stateNow()); });
byId("before").addEventListener("click", () => nextEvent(-1));
byId("next").addEventListener("click", () => nextEvent(1));
byId("play").addEventListener("click", play);
byId("theme").addEventListener("click", theme);
byId("print").addEventListener("click", () => window.print());
byId("marks").addEventListener("click", (event) => { if (event.target.dataset.event) goTo(DATA.ways[view.way].events[Number(event.target.dataset.event)].stop); });
byId("picture").addEventListener("pointermove", pointTo);
byId("picture").addEventListener("pointerdown", pointTo);
document.addEventListener("click", (event) => {
  const button = event.target.closest("button");
  if (!button) return;
  if (button.classList.contains("sort")) sort(button);
  if (button.dataset.jump) {
    const [way, k] = button.dataset.jump.split(" ").map(Number);
    stopsOf(DATA.ways[way]);
    if (DATA.ways[way].events[k].stop >= 0) choose(way, DATA.ways[way].events[k].stop);
    byId("moving").scrollIntoView({ block: "nearest" });
  }
});
document.documentElement.classList.add("scripted");
choose(DATA.first.way, DATA.first.at === null ? null : Math.max(0, stopsOf(DATA.ways[DATA.first.way]).findIndex((one) => one.at === DATA.first.at)));
if (scale) { // the place is at first that of the largest moment
  const state = stateNow() || new State(DATA.ways.find((one) => one.intervals), DATA.ways.find((one) => one.intervals).intervals[0], 0);
  const [one, other] = state.extremes("moment", scale.step);
  view.place = (Math.abs(one.value) >= Math.abs(other.value) ? one : other).x / (scale.end || 1);
  show();
}
