"use strict";
/* A state anywhere: interpolated between the states of the page, then by polynomials along the pieces of the beam. */

const DATA = JSON.parse(document.getElementById("gapbeam-data").textContent);
const SHORT = { deflection: "w", moment: "m", shear: "v", pressure: "p", axial_force: "n" };

/* Single precision in base 64, as Python packed it. */
function unpack(text) {
  return new Float32Array(Uint8Array.from(atob(text), (one) => one.charCodeAt(0)).buffer);
}

/* The columns of a state of a way, each an array; moments left of joints stand beside those right of them. */
function decoded(way, number) {
  const state = way.states[number];
  if (state.columns) return state.columns;
  const columns = {};
  if (way.packed) { // of all states, one after the other
    way.numbers = way.numbers || unpack(way.packed);
    let at = number * way.columns.reduce((sum, [, count]) => sum + count, 0);
    for (const [name, count] of way.columns) columns[name] = way.numbers.subarray(at, (at += count));
  }
  for (const [key, value] of Object.entries(state)) {
    if (key.endsWith("_packed")) columns[key.slice(0, -7)] = unpack(value);
    else if (Array.isArray(value) && key !== "zones" && key !== "free") columns[key] = value;
  }
  if (columns.m && !columns.v && !columns.m_left) {
    columns.m_left = columns.m.slice(1);
    columns.m = columns.m.slice(0, -1);
  }
  state.columns = columns;
  return columns;
}

/* The rows of intervals, and states of trains, as objects. */
for (const way of DATA.ways) {
  if (!way.intervals) continue;
  way.intervals = way.intervals.map(([from, to, scheme, nodes, leg]) => ({ from, to, state: way.schemes[scheme], nodes, leg }));
  if (typeof way.states === "number") way.states = Array.from({ length: way.states }, () => ({}));
}

/* Weights of Lagrange's polynomial through equally spaced nodes; share goes from 0 to 1. */
function weights(count, share) {
  if (count === 1) return [1];
  const at = share * (count - 1);
  return Array.from({ length: count }, (_, i) => {
    let product = 1;
    for (let j = 0; j < count; j++) if (j !== i) product *= (at - j) / (i - j);
    return product;
  });
}

class State {
  /* The state of a way at a place of its slider, in one of its intervals. */
  constructor(way, interval, at) {
    this.way = way;
    this.interval = interval;
    this.at = at;
    this.beam = DATA.beams[way.beam];
    this.supports = DATA.supports[way.supports];
    const share = interval.to > interval.from ? (at - interval.from) / (interval.to - interval.from) : 0;
    const nodes = interval.nodes.map((k) => way.states[k]);
    const mixed = weights(nodes.length, share);
    const only = mixed.filter((one) => one !== 0).length === 1 ? mixed.indexOf(1) : -1;
    this.exactNode = only < 0 ? null : nodes[only];
    const columns = interval.nodes.map((k) => decoded(way, k));
    for (const key of new Set(columns.flatMap(Object.keys))) {
      const all = columns.map((one) => one[key]);
      const filled = all.find((one) => one);
      this[key] = this.exactNode ? columns[only][key] || filled.map(() => 0)
        : Array.from(filled, (_, i) => all.reduce((sum, one, j) => sum + (one ? mixed[j] * one[i] : 0), 0));
    }
    const factors = nodes.map((one) => one.factor);
    this.factor = way.axis === "position" ? 1 : this.exactNode ? this.exactNode.factor
      : factors.reduce((sum, one, j) => sum + mixed[j] * one, 0);
    const near = nodes[Math.round(share * (nodes.length - 1))];
    this.zones = near.zones || [];
    this.parts = this.exactNode ? this.exactNode.n_parts : null;
    this.free = near.free || [];
    this.axles = (way.axles || []).map(([offset, force]) => [at + offset, force]);
    this.bands = (way.uniform || []).map(([q, from, to]) => [at + from, at + to, q]);
    this.words = Array.from(interval.state, (code) => DATA.words[parseInt(code, 36)]);
    if (!this.opening) this.fillSupports();
  }

  /* While a train passes, openings and deflections follow from the beam, reactions from the jumps of the shear. */
  fillSupports() {
    const end = this.beam.x[this.beam.x.length - 1];
    this.reaction = this.reaction || this.supports.map((one, k) => {
      if (one.axial || this.words[k] === "open") return 0;
      const near = (x) => Math.abs(x - one.x) <= 1e-12 * end, joint = this.beam.x.findIndex(near);
      const [dead, live] = this.beam.forces[joint];
      const force = dead + live + this.axles.reduce((sum, [x, value]) => sum + (near(x) ? value : 0), 0);
      const left = joint > 0 ? this.value("shear", this.beam.x[joint], true) : 0;
      return force - left + (joint < this.beam.x.length - 1 ? this.value("shear", this.beam.x[joint]) : 0);
    });
    this.deflection = this.supports.map((one) => (one.axial ? 0 : this.value("deflection", one.x)));
    this.opening = this.supports.map((one, k) => (this.words[k] !== "open" ? 0
      : Math.max(0, one.side * (one.level - this.deflection[k]))));
  }

  /* Loads that a train brings into a piece, as forces at distances from its left end; seen from s a uniform load is four. */
  forces(k, s) {
    const left = this.beam.x[k], length = this.beam.pieces[k][0], found = [];
    for (const [x, force] of this.axles) if (x > left && x < left + length) found.push([x - left, force]);
    for (const [from, to, q] of this.bands) {
      const a = Math.max(from - left, 0), b = Math.min(to - left, length);
      for (const [c, d] of [[a, Math.min(b, s)], [Math.max(a, s), b]]) {
        if (d <= c) continue;
        const middle = (c + d) / 2, away = (d - c) / Math.sqrt(12);
        found.push([middle - away, (q * (d - c)) / 2], [middle + away, (q * (d - c)) / 2]);
      }
    }
    return found;
  }

  /* Piece of a place; on the left side of a joint the piece before it. */
  piece(x, left) {
    const joints = this.beam.x;
    let low = 0, high = joints.length - 2;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (left ? joints[middle] < x : joints[middle] <= x) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /* A field at a place, right of it where it jumps unless the left side is asked for. */
  value(name, x, left = false) {
    const k = this.piece(x, left);
    return this.beam.grid && name !== "axial_force" ? this.onGrid(name, k, x, left) : this.inPiece(name, k, x - this.beam.x[k], left);
  }

  /* Axial force on ground along the beam, straight between the ends of slip zones; between two states of them by many places. */
  inPart(x, left) {
    const parts = this.parts;
    if (!parts) {
      const last = this.n_grid.length - 1, at = Math.min(Math.max((x / this.beam.x[this.beam.x.length - 1]) * last, 0), last);
      const low = Math.min(Math.floor(at), last - 1);
      return this.n_grid[low] + (this.n_grid[low + 1] - this.n_grid[low]) * (at - low);
    }
    const [a, b, from, to] = parts.find(([p, q]) => (left ? x > p && x <= q : x >= p && x < q))
      || parts[x <= parts[0][0] ? 0 : parts.length - 1];
    return b > a ? from + ((to - from) * (x - a)) / (b - a) : from;
  }

  inPiece(name, k, s, left) {
    const [length, flexible, soft] = this.beam.pieces[k], t = s / length, square = length * length;
    if (name === "axial_force" && this.n_grid) return this.inPart(this.beam.x[k] + s, left);
    if (name === "axial_force") return !this.n ? 0 : this.n_left ? this.n[k] * (1 - t) + this.n_left[k] * t : this.n[k];
    const load = [0, 1, 2, 3].map((i) => this.beam.dead[k][i] + this.factor * this.beam.live[k][i]);
    const m0 = this.m[k], m1 = this.m_left[k];
    const c = (load[0] * square) / 2, d = ((load[1] - load[0]) * square) / 6;
    let bubble = c * t * (1 - t) + d * t * (1 - t * t);
    let shear = (m1 - m0) / length + (c * (1 - 2 * t) + d * (1 - 3 * t * t)) / length;
    let w = this.w[k] * (1 - t) + this.w[k + 1] * t - square * t * (1 - t) * (load[2] / 2 + (load[3] * (1 + t)) / 6)
      + square * flexible * (
      (m0 * t * (1 - t) * (2 - t)) / 6 + (m1 * t * (1 - t * t)) / 6 + (c * t * (1 - 2 * t * t + t ** 3)) / 12
      + d * t * (7 / 60 - (t * t) / 6 + t ** 4 / 20));
    for (const [a, force] of this.forces(k, s)) {
      const b = length - a, before = s < a || (s === a && left), [near, arm, run] = before ? [b, b, s] : [a, a, length - s];
      bubble += (force * near * run) / length;
      shear += (before ? force * b : -force * a) / length;
      w += (flexible * force * arm * run * (square - arm * arm - run * run)) / (6 * length);
    }
    w += soft * bubble;
    return name === "moment" ? m0 * (1 - t) + m1 * t + bubble : name === "shear" ? shear : w;
  }

  /* On the ground straight lines between many places; axles bring their jumps and kinks. */
  onGrid(name, k, x, left) {
    const { piece, x: places } = this.beam.grid, column = this[SHORT[name]];
    if (!column) return 0;
    let low = 0, high = places.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (piece[middle] < k || (piece[middle] === k && places[middle] <= x)) low = middle;
      else high = middle;
    }
    if (piece[low] < k) low = high;
    const next = piece[low + 1] === k ? low + 1 : low, length = places[next] - places[low];
    const share = length > 0 ? (x - places[low]) / length : 0;
    let value = column[low] + share * (column[next] - column[low]);
    if (name !== "moment" && name !== "shear") return value;
    const s = x - this.beam.x[k], whole = this.beam.pieces[k][0];
    for (const [a, force] of this.forces(k, s)) {
      const before = s < a || (s === a && left);
      if (name === "moment") value += (force * (before ? (whole - a) * s : a * (whole - s))) / whole;
      else value += (before ? force * (whole - a) : -force * a) / whole;
    }
    return value;
  }

  /* Places of the pieces at which a curve is drawn, as [x, whether left of it]; axles twice. */
  places(step) {
    const found = [], joints = this.beam.x;
    for (let k = 0; k + 1 < joints.length; k++) {
      const a = joints[k], b = joints[k + 1], count = Math.max(2, Math.min(200, Math.ceil((b - a) / step)));
      const inner = this.axles.map(([x]) => x).filter((x) => x > a && x < b);
      const rows = Array.from({ length: count + 1 }, (_, i) => [i === count ? b : a + ((b - a) * i) / count, i === count]);
      for (const x of inner) rows.push([x, true], [x, false]);
      rows.sort((one, other) => one[0] - other[0] || other[1] - one[1]);
      found.push(...rows);
    }
    return found;
  }

  /* Largest and smallest value of a field along the beam with their places. */
  extremes(name, step) {
    const exact = this.exactNode && this.exactNode.extremes && this.exactNode.extremes[name];
    if (exact) return exact[0].map((value, i) => ({ value, x: exact[1][i] }));
    const rows = this.places(step).map(([x, left]) => [this.value(name, x, left), x, left]);
    return [1, -1].map((sign) => {
      let best = 0;
      rows.forEach((row, i) => { if (sign * row[0] > sign * rows[best][0]) best = i; });
      let [value, x] = rows[best];
      if (!this.beam.grid) [value, x] = this.refined(name, rows, best, sign, value, x);
      return { value, x };
    });
  }

  /* The top of a curve beside its highest point, by golden sections; joints stand there twice. */
  refined(name, rows, best, sign, value, x) {
    const part = (Math.sqrt(5) - 1) / 2, top = x;
    for (let i = Math.max(0, best - 2); i < Math.min(rows.length - 1, best + 2); i++) {
      let from = rows[i][1], to = rows[i + 1][1];
      if (from === to || (from !== top && to !== top)) continue;
      for (let n = 0; n < 60; n++) {
        const a = to - part * (to - from), b = from + part * (to - from);
        if (sign * this.value(name, a) > sign * this.value(name, b)) to = b;
        else from = a;
      }
      const there = (from + to) / 2, found = this.value(name, there);
      if (sign * found > sign * value) [value, x] = [found, there];
    }
    return [value, x];
  }
}
