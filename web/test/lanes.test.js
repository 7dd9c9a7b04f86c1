import assert from "node:assert/strict";
import test from "node:test";
import { lanes } from "../src/playback/lanes.js";

test("what meets goes into the next lane, what does not stays in the first", () => {
  assert.deepEqual(lanes([[0, 10], [5, 8], [10, 20], [7, 12]]), [0, 1, 0, 2]);
  assert.deepEqual(lanes([]), []);
});
