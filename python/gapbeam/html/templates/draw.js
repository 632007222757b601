/* The picture of a state: the model with loads, supports and reactions, and a panel for every field. */

const WIDTH = 1000, LEFT = 84, RIGHT = 28, PANEL = 148, TITLE = 30, FOOT = 20;
const MODEL = { loads: 122, lift: 34, labels: 88, level: 28, levels: 4 };
const TURNED = 46; // pixels between supports below which their numbers are turned
const MOST_DRAWN = 400; // supports and loads that are drawn one by one
const MOST_NAMED = 60; // supports whose numbers are written

function number(value, digits = 5) {
  if (value === null || !Number.isFinite(value)) return "";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 10 ** digits && size < 1e7) return value.toFixed(0).replace("-", "\u2212");
  const rounded = Number(value.toPrecision(digits)), power = Math.floor(Math.log10(Math.abs(rounded)));
  let text = String(rounded);
  if (power < -4 || power >= digits) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    const signed = Number(exponent);
    text = `${String(Number(mantissa))}e${signed < 0 ? "-" : "+"}${String(Math.abs(signed)).padStart(2, "0")}`;
  }
  return text.replace(/^-/, "\u2212");
}

/* A value in the unit that is shown, without or with it. */
function shown(name, value) { return number(value * DATA.units[name][1]); }
function withUnit(name, value) { return `${shown(name, value)} ${DATA.units[name][0]}`.trim(); }
function escaped(text) { return String(text).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" }[c])); }

/* Supports along the beam, and joints that hold a rotation: their reactions are no arrows across it. */
function beside(support) { return support.axial || support.turns; }

/* What has the same scale in all states: the size of fields, reactions, openings, loads. */
class Scale {
  constructor() {
    const beam = DATA.beams[0];
    this.end = beam.x[beam.x.length - 1];
    this.step = this.end / 320;
    this.ranges = {};
    this.reaction = 0;
    for (const { name } of DATA.panels) this.ranges[name] = [0, 0];
    const stretch = (name, value) => {
      const range = this.ranges[name];
      if (range && Number.isFinite(value)) [range[0], range[1]] = [Math.min(range[0], value), Math.max(range[1], value)];
    };
    this.curves = DATA.envelope && { x: unpack(DATA.envelope.x), fields: {} };
    for (const [name, pair] of Object.entries(DATA.envelope ? DATA.envelope.fields : {})) {
      this.curves.fields[name] = pair.map(unpack);
      for (const curve of this.curves.fields[name]) curve.forEach((value) => stretch(name, value));
    }
    for (const way of DATA.ways) {
      for (const interval of way.intervals || []) {
        for (const at of interval.from < interval.to ? [interval.from, interval.to] : [interval.from]) {
          const state = new State(way, interval, at);
          const places = state.places(this.end / 60);
          for (const { name } of DATA.panels) places.forEach(([x, left]) => stretch(name, state.value(name, x, left)));
          state.reaction.forEach((value, k) => { if (!beside(state.supports[k])) this.reaction = Math.max(this.reaction, Math.abs(value)); });
        }
      }
    }
    const seats = DATA.supports.flat().map((one) => Math.abs(one.level));
    const range = this.ranges.deflection, deepest = Math.max(-range[0], range[1]);
    this.lift = MODEL.lift / (Math.max(deepest, ...seats.filter((one) => one <= 4 * deepest)) || 1);
    const loads = DATA.loads.flat();
    const largest = (values) => Math.max(0, ...values.map(Math.abs)) || 1;
    this.force = largest([...loads.filter((one) => one.type === "force").map((one) => one.value),
      ...DATA.ways.flatMap((way) => way.axles || []).map(([, force]) => force)]);
    if (DATA.supports.some((supports) => supports.length <= MOST_NAMED && spacingOf(supports) < TURNED)) MODEL.labels = 185;
    MODEL.loads += MODEL.level * Math.max(0, ...DATA.loads.map(stack));
    this.uniform = largest([...loads.filter((one) => one.ends && !isFlat(one)).flatMap((one) => one.ends),
      ...DATA.ways.flatMap((way) => way.uniform || []).map(([q]) => q)]);
  }

  x(place) { return LEFT + (place / (this.end || 1)) * (WIDTH - LEFT - RIGHT); }
}

/* The least distance of two places with supports (pixels). */
function spacingOf(supports) {
  const places = [...new Set(supports.filter((one) => !beside(one)).map((one) => one.x))].sort((a, b) => a - b), beam = DATA.beams[0];
  const least = Math.min(beam.x[beam.x.length - 1], ...places.slice(1).map((x, k) => x - places[k]));
  return ((WIDTH - LEFT - RIGHT) * least) / (beam.x[beam.x.length - 1] || 1);
}

/* Places of turned labels: those of their supports, moved to the right as far as others are there. */
function apart(places, least = 12) {
  const order = places.map((x, k) => [x, k]).sort((a, b) => a[0] - b[0]), found = [];
  order.forEach(([x, k], i) => { found[k] = i ? Math.max(x, found[order[i - 1][1]] + least) : x; });
  const over = Math.max(0, ...found) - (WIDTH - 6);
  return over > 0 ? found.map((x) => x - over) : found;
}

function line(x1, y1, x2, y2, name) { return `<line x1="${x1.toFixed(1)}" y1="${y1.toFixed(1)}" x2="${x2.toFixed(1)}" y2="${y2.toFixed(1)}" class="${name}"/>`; }
function words(x, y, text, name = "", more = "") { return `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" class="${name}" ${more}>${escaped(text)}</text>`; }
function path(points, name, closed = false) {
  return `<path class="${name}" d="M${points.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join("L")}${closed ? "Z" : ""}"/>`;
}

/* An arrow with its tip at (x, tip), coming from above where length is positive. */
function arrow(x, tip, length, name) {
  const sign = Math.sign(length) || 1;
  return line(x, tip - length, x, tip - sign * 3, name) + path([[x - 3.5, tip - sign * 8], [x + 3.5, tip - sign * 8], [x, tip]], `${name} head`, true);
}

/* Put distributed loads that overlap above each other; the number of the highest level. */
function stack(loads) {
  const bands = loads.filter((one) => one.ends);
  bands.forEach((one, i) => {
    const taken = bands.slice(0, i).filter((other) => other.from < one.to && one.from < other.to).map((other) => other.level);
    one.level = Math.min(MODEL.levels, [0, 1, 2, 3, 4].find((level) => !taken.includes(level)) ?? MODEL.levels);
  });
  return Math.max(0, ...bands.map((one) => one.level));
}

/* The model: beam, loads, supports, reactions. */
function drawModel(state, scale, axis, changed) {
  const y = (x, left) => axis + scale.lift * state.value("deflection", x, left);
  const parts = [line(scale.x(0), axis, scale.x(scale.end), axis, "rest")];
  if (DATA.upright) parts.push(words(8, axis - 26, "top", "title"), words(WIDTH - 14, axis - 26, "foot", "name"));
  for (const [, from, to, name] of state.zones) parts.push(path(along(state, scale, from, to, 7), name === "touching" ? "ground touching" : "ground"));
  for (const [, from, to] of state.free) parts.push(path(along(state, scale, from, to, 7), "ground free"));
  parts.push(path(along(state, scale, 0, scale.end, 0), "girder"));
  for (const x of DATA.along) parts.push(halfArrows(scale.x(x), y(x, false) + 9));
  for (const x of state.beam.hinges) parts.push(`<circle cx="${scale.x(x).toFixed(1)}" cy="${y(x, false).toFixed(1)}" r="4" class="hinge"/>`);
  parts.push(drawLoads(state, scale, y, axis));
  parts.push(drawSupports(state, scale, y, axis, changed));
  return parts.join("");
}

/* What holds the beam along its axis: two half arrows, as of shear. */
function halfArrows(x, y) {
  return path([[x - 7, y - 1.5], [x + 7, y - 1.5], [x + 2, y - 5]], "held") + path([[x + 7, y + 1.5], [x - 7, y + 1.5], [x - 2, y + 5]], "held");
}

function along(state, scale, from, to, below) {
  const count = Math.max(2, Math.ceil(((to - from) / (scale.end || 1)) * 240));
  return Array.from({ length: count + 1 }, (_, i) => {
    const x = from + ((to - from) * i) / count;
    return [scale.x(x), below + MODEL.loads + MODEL.lift + scale.lift * state.value("deflection", x, i === count)];
  });
}

/* Loads over a stretch that act neither down nor up: imposed curvatures, temperatures that lengthen, and loads along the beam. */
function isFlat(load) {
  return ["curvature", "temperature", "axial_uniform"].includes(load.type);
}

/* What a load over a stretch is, with its unit; temperatures have none. */
function bandText(one, factor) {
  if (one.changes) return Object.entries(one.changes).map(([name, value]) => `${name} ${number(factor * value, 4)}`).join(", ");
  const along = one.type === "axial_uniform", bends = one.type === "curvature";
  const [from, to] = one.ends.map((q) => number(along ? Math.abs(factor * q) : factor * q, 4));
  const sign = bends ? "\u03ba " : !along ? "" : factor * one.ends[0] < 0 ? "\u2190 " : "\u2192 ";
  return `${sign}${from === to ? from : `${from} to ${to}`} ${DATA.units[bends ? "curvature" : "uniform"][0]}`;
}

function drawLoads(state, scale, y, axis) {
  const parts = [], loads = DATA.loads[state.way.loads].slice(0, MOST_DRAWN), taken = [], top = axis - MODEL.lift - 58;
  const factorOf = (one) => (one.dead ? 1 : state.factor), label = loads.length <= 14;
  for (const one of loads) {
    const factor = factorOf(one);
    if (factor === 0) continue;
    if (one.ends) {
      const [a, b] = one.ends.map((q) => (isFlat(one) ? 5 : (Math.abs(factor * q) / scale.uniform) * 14));
      const left = scale.x(one.from), right = scale.x(one.to), foot = top - MODEL.level * one.level;
      parts.push(path([[left, foot], [left, foot - a], [right, foot - b], [right, foot]], isFlat(one) ? "band bent" : "band", true));
      const text = bandText(one, factor);
      const half = halfOf(text), middle = Math.min(Math.max((left + right) / 2, 4 + half), WIDTH - 4 - half);
      if (label) parts.push(words(middle, foot - Math.max(a, b) - 3, text, "load"));
    } else if (one.type === "movement") parts.push(drawMovement(one, factor, scale, y(one.x, false), label && taken));
    else if (one.type === "force") parts.push(drawForce(scale, one.x, factor * one.value, y(one.x, false), label && taken));
    else {
      const x = scale.x(one.x), at = y(one.x, false), turn = Math.sign(factor * one.value);
      if (one.type === "moment") {
        parts.push(`<path class="couple" d="M${x - 11 * turn},${at} A11,11 0 0 ${turn > 0 ? 1 : 0} ${x + 11 * turn},${at}"/>`,
          path([[x + 11 * turn - 4, at - 3], [x + 11 * turn + 4, at - 3], [x + 11 * turn, at + 4]], "force head", true));
      } else parts.push(line(x - 26 * turn, at - 12, x, at - 12, "force"), path([[x - 7 * turn, at - 16], [x - 7 * turn, at - 8], [x, at - 12]], "force head", true));
      const text = withUnit(one.type === "moment" ? "moment" : "reaction", factor * one.value);
      if (label) parts.push(loadLabel(taken, x + 16 + halfOf(text), at + 24, text, 1));
    }
  }
  for (const [x, force] of state.axles) {
    if (x >= 0 && x <= scale.end) parts.push(drawForce(scale, x, force, y(x, false), state.axles.length <= 6 && taken, "axle"));
  }
  for (const [from, to, q] of state.bands) {
    const [left, right] = [from, to].map((x) => scale.x(Math.min(Math.max(x, 0), scale.end)));
    if (right > left) parts.push(path([[left, top], [left, top - (14 * q) / scale.uniform], [right, top - (14 * q) / scale.uniform], [right, top]], "band axle", true));
  }
  return parts.join("");
}

/* What moves a support or the ground: an arrow beside it, an arc where it turns, and how far. */
function drawMovement(one, factor, scale, at, taken) {
  const x = scale.x(one.x), sign = Math.sign(factor * one.moves[0]), turns = one.way === "turn", right = x < WIDTH / 2;
  const far = one.moves.map((moved) => withUnit(turns ? "rotation" : "deflection", factor * moved)), said = [...new Set(far)].join(" to ");
  if (one.way === "ground") return taken ? loadLabel(taken, x, at + 34, `ground moves ${said}`, 1) : "";
  const verb = `${turns ? "turns" : "moves"} ${said}`, off = (right ? 1 : -1) * (22 + halfOf(verb));
  const text = taken ? loadLabel(taken, x + off, turns ? at - 18 : at + 34, verb, turns ? -1 : 1) : "";
  if (turns) {
    const end = x + 15 * sign, head = path([[end - 4, at - 3], [end + 4, at - 3], [end, at + 4]], "force head", true);
    return `<path class="couple" d="M${x - 15 * sign},${at} A15,15 0 0 ${sign > 0 ? 1 : 0} ${end},${at}"/>${head}${text}`;
  }
  if (one.way === "along") {
    const tip = x + (right ? -18 : 18) + 10 * sign, head = path([[tip - 8 * sign, at - 4], [tip - 8 * sign, at + 4], [tip, at]], "force head", true);
    return line(tip - 20 * sign, at, tip - 3 * sign, at, "force") + head + text;
  }
  return arrow(x + (right ? 16 : -16), sign > 0 ? at + 28 : at + 6, 20 * sign, "force") + text;
}

/* Half the width of a text (pixels), about. */
function halfOf(text) { return 2.9 * text.length; }

/* A label of a load on the page, moved down or up as long as it would cover another one. */
function loadLabel(taken, x, y, text, down) {
  const half = halfOf(text), middle = Math.min(Math.max(x, 4 + half), WIDTH - 4 - half);
  while (taken.some(([other, wide, low]) => Math.abs(other - middle) < half + wide && Math.abs(low - y) < 11)) y += 11 * down;
  taken.push([middle, half, y]);
  return words(middle, y, text, "load");
}

/* A force with its value. */
function drawForce(scale, x, force, at, taken, name = "force") {
  const length = 14 + 26 * (Math.abs(force) / scale.force), sign = Math.sign(force) || 1;
  const text = taken ? loadLabel(taken, scale.x(x), at - 8 - length, withUnit("reaction", force), -1) : "";
  return arrow(scale.x(x), sign > 0 ? at - 4 : at - 4 - length, sign * length, name) + text;
}

/* Supports: filled where they act, hollow where they are open, with what they carry or how far they are open. */
function drawSupports(state, scale, y, axis, changed) {
  const parts = [], supports = state.supports, across = supports.filter((one) => !beside(one)).length;
  const spacing = spacingOf(supports);
  const size = Math.min(9, Math.max(3, spacing / 3)), low = axis + MODEL.lift + 24, turned = spacing < TURNED;
  const labels = apart(supports.map((one) => (beside(one) || one.side < 0 ? -1e9 : scale.x(one.x) + 4)));
  supports.forEach((one, k) => {
    if (across > MOST_DRAWN && state.words[k] !== "open" && k % Math.ceil(across / MOST_DRAWN)) return;
    const x = scale.x(one.x), at = y(one.x, false), above = one.side < 0, branch = /^branch (\d+)/.exec(state.words[k]);
    const open = state.words[k] === "open", idle = open || (branch && Math.abs(state.reaction[k]) <= 1e-9 * scale.reaction);
    if (one.axial) {
      parts.push(`<rect x="${(x - 13).toFixed(1)}" y="${(at - 5).toFixed(1)}" width="7" height="10" class="support bilateral"/>`);
      return;
    }
    if (one.turns) { // a joint, filled where it holds
      parts.push(`<g class="support ${open ? "open" : "closed"}${changed.has(k) ? " changed" : ""}" data-support="${k}" data-state="${state.words[k]}"><circle cx="${x.toFixed(1)}" cy="${at.toFixed(1)}" r="5.5" class="symbol"/></g>`);
      return;
    }
    const way = above ? -1 : 1, shares = above && supports.some((other, j) => j !== k && other.x === one.x && other.side >= 0 && state.words[j] !== "open");
    let tip = at + way * 3;
    if (idle && one.side !== 0) tip = way * Math.max(way * (axis + scale.lift * (state.deflection[k] + one.side * state.opening[k])) + 3, way * at + 7);
    const kind = idle ? "open" : one.side === 0 ? "bilateral" : "closed";
    parts.push(`<g class="support ${kind}${changed.has(k) ? " changed" : ""}" data-support="${k}" data-state="${state.words[k]}">`);
    if (one.turning === 2) parts.push(line(x, at - 12, x, at + 12, "wall"));
    parts.push(path([[x, tip], [x - size, tip + way * size * 1.6], [x + size, tip + way * size * 1.6]], "symbol", true));
    if (one.turning === 1) parts.push(`<circle cx="${x.toFixed(1)}" cy="${at.toFixed(1)}" r="5" class="turning"/>`);
    if (one.side === 0) parts.push(line(x - size, at - 4, x + size, at - 4, "symbol"));
    parts.push(line(x - size - 2, tip + way * (size * 1.6 + 2.5), x + size + 2, tip + way * (size * 1.6 + 2.5), one.elastic ? "base elastic" : "base"));
    if (branch && Number(branch[1]) > 1) parts.push(words(x, tip + way * size * 1.2 + 3, branch[1], "branch"));
    parts.push("</g>");
    if (across > MOST_NAMED) return;
    const value = state.reaction[k], text = open ? `${above ? "\u2193" : "\u2191"}${shown("opening", state.opening[k])}` : shown("reaction", value);
    const length = scale.reaction ? 6 + 16 * (Math.abs(value) / scale.reaction) : 0;
    if (above) {
      const right = x > WIDTH - 90, label = open && shares ? "" : text;
      if (!turned) parts.push(`<text x="${(x + (right ? -1 : 1) * (size + 5)).toFixed(1)}" y="${(tip - size).toFixed(1)}" class="value beside ${open ? "opened" : ""}" style="text-anchor:${right ? "end" : "start"}">${escaped(label)}</text>`);
      else if (!open) parts.push(words(x, tip - size * 1.6 - 8, text, "value"));
      return;
    }
    if (!idle && value) parts.push(value > 0 ? arrow(x, low, -length, "reaction") : arrow(x, low + length, length, "reaction"));
    const foot = low + 36;
    if (turned) parts.push(words(labels[k], foot - 8, `${shortened(one.name, Math.max(6, 19 - text.length))}: ${text}`, `value ${open ? "opened" : ""}`, turnedAt(labels[k], foot - 8)));
    else parts.push(words(Math.min(x, WIDTH - 4 - halfOf(text)), foot, text, `value ${open ? "opened" : ""}`), words(...named(x, foot + 13, one.name, spacing), "name"));
  });
  if (across && across <= MOST_NAMED && spacing >= TURNED) parts.push(words(8, low + 36, DATA.units.reaction[0], "title"), words(8, low + 49, "support", "title"));
  return parts.join("");
}

function shortened(name, most) { return name.length > most ? `${name.slice(0, most - 1)}\u2026` : name; }

/* A name under its support, cut where others have their room, beside the word at the left and before the end of the picture. */
function named(x, y, name, spacing) {
  const text = shortened(name, Math.max(9, Math.floor(spacing / 6.2))), half = 3 * text.length;
  return [Math.min(Math.max(x, 62 + half), WIDTH - 4 - half), y, text];
}

function turnedAt(x, y) { return `transform="rotate(-90 ${x.toFixed(1)} ${y.toFixed(1)})" style="text-anchor:end"`; }

/* One field along the beam. */
function drawPanel(state, scale, panel, top) {
  const { name, words: title, down } = panel, [low, high] = scale.ranges[name], size = high - low || 1, height = PANEL - TITLE - FOOT;
  const y = (value) => top + TITLE + ((down ? value - low : high - value) / size) * height;
  const parts = [`<g class="panel" data-panel="${name}">`];
  const unit = DATA.units[name][0];
  parts.push(words(8, top + 10, unit ? `${title} [${unit}]` : title, "title"));
  const curve = scale.curves && scale.curves.fields[name];
  if (curve) {
    const x = Array.from(scale.curves.x), row = (values) => x.map((one, i) => [scale.x(one), y(values[i])]).filter(([, at]) => Number.isFinite(at));
    parts.push(path([...row(Array.from(curve[0])), ...row(Array.from(curve[1])).reverse()], "envelope", true));
  }
  const points = state.places(scale.step).map(([x, left]) => [scale.x(x), y(state.value(name, x, left))]);
  parts.push(path([[scale.x(0), y(0)], ...points, [scale.x(scale.end), y(0)]], "area", true), line(scale.x(0), y(0), scale.x(scale.end), y(0), "axis"));
  parts.push(path(points, "curve"));
  const taken = [];
  for (const { value, x } of state.extremes(name, scale.step)) {
    if (Math.abs(value) <= 1e-9 * size || taken.includes(value)) continue;
    taken.push(value);
    const at = y(value), under = (value > 0) === down, text = `${shown(name, value)} at ${number(x)}`;
    const wide = 3.3 * text.length, place = Math.min(Math.max(scale.x(x), LEFT - 8 + wide), WIDTH - wide - 4);
    parts.push(`<circle cx="${scale.x(x).toFixed(1)}" cy="${at.toFixed(1)}" r="2.6" class="dot"/>`);
    parts.push(words(place, under ? at + 13 : at - 5, text, "peak", `data-value="${value}" data-x="${x}"`));
  }
  parts.push("</g>");
  return parts.join("");
}

/* How a beam moves that cannot stand, for a share of that motion. */
function drawMotion(way, share, axis) {
  const last = way.motion[way.motion.length - 1], end = last ? last[0] : 1, x = (place) => LEFT + (place / end) * (WIDTH - LEFT - RIGHT);
  const points = way.motion.map(([place, moved]) => [x(place), axis + 60 * share * moved]);
  const parts = [line(LEFT, axis, WIDTH - RIGHT, axis, "rest")];
  if (points.length) parts.push(path(points, "girder moving"));
  const ends = DATA.loads[way.loads].filter((one) => one.type === "force");
  for (const one of ends) parts.push(arrow(x(one.x), axis - 6, 30 * Math.sign(one.value), "force"));
  for (const one of DATA.supports[way.supports]) {
    const way_ = one.side < 0 ? -1 : 1, at = x(one.x);
    parts.push(`<g class="support ${one.side ? "open" : "bilateral"}">${path([[at, axis + way_ * 4], [at - 9, axis + way_ * 18], [at + 9, axis + way_ * 18]], "symbol", true)}</g>`,
      words(at, axis + way_ * 18 + (way_ > 0 ? 16 : -8), one.name, "name"));
  }
  return parts.join("");
}

/* The whole picture of a state, the line of the place below everything. */
function picture(state, scale, changed) {
  const axis = MODEL.loads + MODEL.lift, bottom = axis + MODEL.lift + MODEL.labels;
  const parts = ['<g id="cursor"></g>', drawModel(state, scale, axis, changed)];
  const panels = DATA.panels.filter(({ name }) => name !== "axial_force" || state.n);
  panels.forEach((panel, i) => parts.push(drawPanel(state, scale, panel, bottom + i * PANEL)));
  return { svg: parts.join(""), height: bottom + panels.length * PANEL + 6 };
}
