/**
 * The first lane, counted from 0, in which each span finds room beside those before it.
 * @param {[number, number][]} spans  begin and end
 * @returns {number[]}
 */
export function lanes(spans) {
  const taken = [];
  return spans.map(([begin, end]) => {
    let lane = 0;
    while (taken[lane]?.some(([b, e]) => begin < e && end > b)) ++lane;
    (taken[lane] ??= []).push([begin, end]);
    return lane;
  });
}
