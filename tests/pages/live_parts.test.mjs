// The pure parts of the live instruments, against numbers that test_live_parts.py writes to the file SIMC_CASES.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { marginsOf } from "../../pages/common/live/cascade/loops.js";
import { nearest, round, text } from "../../pages/common/live/kit/format.js";
import { crowded, typeFor } from "../../pages/common/live/kit/lecture.js";
import { letters } from "../../pages/common/live/kit/letters.js";
import message from "../../pages/common/live/kit/message.js";
import { mount } from "../../pages/common/live/kit/mount.js";
import { namesOf } from "../../pages/common/live/kit/names.js";
import { seen } from "../../pages/common/live/kit/overlay.js";
import { logTicks, square } from "../../pages/common/live/kit/panel.js";
import { bounded, stretched } from "../../pages/common/live/kit/pinch.js";
import { between, mix, sensitivities, stencil, unpack } from "../../pages/common/live/kit/table.js";

const cases = JSON.parse(readFileSync(process.env.SIMC_CASES, "utf-8"));
const close = (ours, theirs, rel, words) =>
  assert.ok(Math.abs(ours - theirs) <= rel * Math.max(1e-12, Math.abs(theirs)), `${words}: ${ours}, not ${theirs}`);

test("a curve between rows is the polynomial through the rows, never across a kink", () => {
  for (const { nodes, breaks, x, first, values, wanted } of cases.stencils) {
    const found = stencil(x, nodes, breaks);
    assert.equal(found.first, first);
    const block = { columns: 1, values };
    close(mix(block, found)[0], wanted, 1e-9, `at ${x}`);
  }
});

test("a figure between rows keeps what is infinite", () => {
  assert.equal(between([1, 3], 0.25, [0, 1]), 1.5);
  assert.equal(between([Infinity, Infinity], 0.25, [0, 1]), Infinity);
  assert.equal(between([2, Infinity], 0, [0, 1]), 2);
});

test("tables are unpacked to what was packed", () => {
  const message = unpack(Uint8Array.from(Buffer.from(cases.packed.base64, "base64")));
  assert.equal(message.kind, "table");
  assert.deepEqual(Array.from(message.blocks.y.values), cases.packed.y.flat());
  assert.deepEqual([message.blocks.y.rows, message.blocks.y.columns], [2, 3]);
});

test("margins of both loops of a cascade", () => {
  for (const { omega, re, im, margins } of cases.loops) {
    const found = marginsOf(omega, { x: re, y: im });
    for (const [name, value] of Object.entries(margins)) close(found[name], value, 2e-3, name);
  }
});

test("|S| and |T|", () => {
  for (const { re, im, S, T } of cases.loops) {
    const found = sensitivities(re, im);
    S.forEach((value, i) => {
      close(found.S[i], value, 1e-12, "S");
      close(found.T[i], T[i], 1e-12, "T");
    });
  }
});

test("numbers have four digits", () => {
  for (const [value, digits, wanted] of cases.numbers) assert.equal(text(value, digits), wanted);
  assert.equal(text(Infinity), "∞");
  assert.equal(text(NaN), "–");
});

test("scales: round limits hold what they are given; a decade has 1 to 9; the nearest point is found", () => {
  for (const [low, high] of cases.ranges) {
    const [from, to] = round(low, high);
    assert.ok(from <= low + 1e-9 * (high - low) && to >= high - 1e-9 * (high - low), `${low} to ${high}`);
    assert.ok(to - from <= 1.5 * (high - low), `${low} to ${high}: ${from} to ${to}`);
  }
  assert.deepEqual(
    logTicks(12.6, 1500),
    [20, 30, 40, 50, 60, 70, 80, 90, 100, 200, 300, 400, 500, 600, 700, 800, 900, 1000],
  );
  assert.equal(nearest([1, 2, 4, 8], 5.9), 2);
  assert.equal(nearest([1, 2, 4, 8], 6.1), 3);
  const { x, y } = square({ bbox: { width: 200, height: 100 } }, [0, 1], [0, 1]);
  close((x[1] - x[0]) / 200, (y[1] - y[0]) / 100, 1e-12, "one unit is as long on both axes");
});

test("letters of a lecture are 28 px on a large screen, in proportion to the smaller side, and never below 14", () => {
  assert.equal(typeFor(1920, 1080), 28);
  assert.equal(typeFor(3840, 2160), 56);
  assert.equal(typeFor(1024, 1080), typeFor(1024, 768));
  assert.equal(typeFor(390, 844), 14);
  assert.deepEqual([crowded(1024, 768), crowded(860, 560), crowded(390, 844)], [false, true, true]);
});

test("the future of a curve is what lies beyond the instant; an aid stays", () => {
  const curve = { x: [0, 1, 2, 3], y: [5, 6, 7, 8] };
  assert.deepEqual(seen(curve, {}, "future", 1), { x: [0, 1], y: [5, 6] });
  assert.deepEqual(seen(curve, {}, "curves", 1), { x: [], y: [] });
  assert.deepEqual(seen(curve, {}, "future", 9), curve);
  assert.deepEqual(seen(curve, {}, "", 1), curve);
  assert.deepEqual(seen(curve, { aid: true }, "curves", 1), curve);
});

test("what lay under two fingers stays under them, on a logarithmic axis too", () => {
  for (const [limits, log] of [
    [[0, 160], false],
    [[0.01, 100], true],
  ]) {
    const value = ([low, high], share) => (log ? low * (high / low) ** share : low + (high - low) * share);
    const found = stretched(limits, log, [0.4, 0.6], [0.2, 0.9]);
    close(value(found, 0.2), value(limits, 0.4), 1e-9, "the first finger");
    close(value(found, 0.9), value(limits, 0.6), 1e-9, "the second one");
    assert.deepEqual(stretched(limits, log, [0.5, 0.51], [0.4, 0.6]), limits);
  }
});

test("a zoom ends before ticks and numbers do, however often it is done again", () => {
  assert.ok(bounded([0, 160], [0, 160], false));
  assert.ok(!bounded([200, 300], [0, 160], false), "nothing of the curves in sight");
  assert.ok(!bounded([1, Number.NaN], [0, 160], false));
  for (const [whole, log] of [
    [[0, 160], false],
    [[0.01, 100], true],
  ])
    for (const [from, to] of [
      [
        [0.05, 0.95],
        [0.45, 0.55],
      ],
      [
        [0.45, 0.55],
        [0.05, 0.95],
      ],
    ]) {
      let limits = whole;
      for (let i = 0; i < 500; i++) {
        const next = stretched(limits, log, from, to);
        if (bounded(next, whole, log)) limits = next;
      }
      assert.ok(limits[1] > limits[0]);
      assert.ok(logTicks(...(log ? limits : [1, 10])).length < 1000);
    }
});

test("a pinned curve is named where it is farthest from the others, and stays named there under a hand", () => {
  const u = { over: { clientWidth: 100, clientHeight: 100 }, valToPos: (v, axis) => (axis === "x" ? v : 100 - v) };
  const x = Array.from({ length: 101 }, (_, i) => i);
  const bump = (at, high) => ({ x, y: x.map((t) => 50 + high * Math.exp(-(((t - at) / 10) ** 2))) });
  const styles = [{ aid: true }, { name: "A" }, { name: "B" }, {}];
  const panel = { spec: { styles }, curves: [bump(50, 0), bump(20, 30), bump(70, 30), bump(0, 0)], hides: "" };
  assert.deepEqual(
    namesOf(panel, u).map(({ x: t, label }) => [t, label]),
    [
      [20, "A"],
      [70, "B"],
    ],
  );
  panel.curves[1] = bump(40, 30);
  panel.moving = true;
  assert.equal(namesOf(panel, u)[0].x, 20);
  panel.moving = false;
  assert.equal(namesOf(panel, u)[0].x, 40);
  assert.deepEqual(namesOf({ ...panel, hides: "curves" }, u), []);
  const alike = { ...panel, curves: [x, x, x, x].map(() => bump(50, 0)) };
  assert.ok(
    namesOf(alike, u).every(({ x: t }) => t === 100),
    "at their ends",
  );
});

test("an instrument that is called again before it is told that it is over stays, with what it has heard", async () => {
  globalThis.document = { createElement: () => ({ remove() {} }), body: { prepend() {} } };
  globalThis.addEventListener = globalThis.removeEventListener = () => {};
  const begun = [];
  const makes = mount("test", (root) => {
    const one = { root, heard: [], left: 0, take: (message) => one.heard.push(message.kind), leave: () => one.left++ };
    begun.push(one);
    return one;
  });
  const page = { querySelector: () => page.live, live: {} };
  const data = packed({ kind: "table", blocks: [] });
  const turns = () => new Promise((done) => setTimeout(done, 5));
  const first = makes({ parentElement: page, data, setTriggerValue() {} });
  first(); // Streamlit: other data came while the script was loaded
  const second = makes({ parentElement: page, data, setTriggerValue() {} });
  await turns();
  assert.equal(begun.length, 1);
  assert.equal(begun[0].left, 0);
  letters("test").open({ kind: "exact" });
  assert.deepEqual(begun[0].heard, ["table", "table", "exact"]);
  second();
  await turns();
  assert.equal(begun[0].left, 1);
  assert.equal(letters("test").open, null);
  makes({ parentElement: page, data, setTriggerValue() {} }); // and back
  assert.equal(begun.length, 1);
  page.live = {}; // its HTML is set anew
  makes({ parentElement: page, data, setTriggerValue() {} });
  assert.deepEqual([begun.length, begun[0].left], [2, 2]);
});

test("what is said once is heard once, by the instrument of any language", () => {
  const heard = [];
  letters("a").open = letters("b").open = ({ kind }) => heard.push(kind);
  for (const to of ["a", "a", "b"]) message({ data: packed({ to, kind: "lecture", once: "7f", blocks: [] }) });
  message({ data: packed({ to: "a", kind: "lecture", once: "80", blocks: [] }) });
  for (const _ of [1, 2]) message({ data: packed({ to: "a", kind: "exact", blocks: [] }) });
  assert.deepEqual(heard, ["lecture", "lecture", "exact", "exact"]);
});

function packed(header) {
  const text = new TextEncoder().encode(JSON.stringify(header));
  const bytes = new Uint8Array(4 + text.length);
  new DataView(bytes.buffer).setUint32(0, text.length, true);
  bytes.set(text, 4);
  return bytes;
}
