// SPDX-License-Identifier: GPL-3.0-or-later
// What can be said exactly of a polygon [[x, y, z, r, g, b], ...] at a sample. Rational numbers are pairs of BigInt.
'use strict';
const Exact = (() => {
  const gcd = (a, b) => { while (b) [a, b] = [b, a % b]; return a < 0n ? -a : a; };
  /// "12/7 = 1.71", "3"
  const text = (n, d) => {
    if (d < 0n) n = -n, d = -d;
    const g = gcd(n, d) || 1n;
    n /= g, d /= g;
    return d === 1n ? `${n}` : `${n}/${d} = ${(Number(n) / Number(d)).toFixed(2)}`;
  };

  /// As a factor or a term: "(−3)" where it is negative.
  const signed = (n) => n < 0 ? `(−${-n})` : `${n}`;

  /// The plane n(x, y) / d through all corners of one component; null where they are not on one.
  const plane = (polygon, component) => {
    const v = polygon.map((q) => [q[0], q[1], q[component]].map(BigInt));
    for (let i = 1; i + 1 < v.length; ++i) {
      const [a, b, c] = [v[0], v[i], v[i + 1]];
      const d = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
      if (d === 0n) continue;
      const dx = (b[2] - a[2]) * (c[1] - a[1]) - (c[2] - a[2]) * (b[1] - a[1]);
      const dy = (c[2] - a[2]) * (b[0] - a[0]) - (b[2] - a[2]) * (c[0] - a[0]);
      const n = (x, y) => a[2] * d + (BigInt(x) - a[0]) * dx + (BigInt(y) - a[1]) * dy;
      if (v.some((q) => n(q[0], q[1]) !== q[2] * d)) return null;
      // The same in floating point, for whole pictures.
      const [sx, sy] = [Number(dx) / Number(d), Number(dy) / Number(d)], [ax, ay, az] = a.map(Number);
      return {n, d, approximately: (x, y) => az + (x - ax) * sx + (y - ay) * sy};
    }
    return null;
  };

  /// The edges that count on row y under the rule lb, from left to right, and what decides for the sample (x, y).
  const decisions = (polygon, x, y) => {
    const list = [];
    polygon.forEach((p, i) => {
      let low = p, high = polygon[(i + 1) % polygon.length];
      if (low[1] > high[1]) [low, high] = [high, low];
      if (y < low[1] || y >= high[1]) return;
      const [x1, y1, x2, y2] = [low[0], low[1], high[0], high[1]].map(BigInt);
      const value = (BigInt(x) - x1) * (y2 - y1) - (BigInt(y) - y1) * (x2 - x1);
      list.push({low, high, value, counts: value >= 0n,
        crossing: text(x1 * (y2 - y1) + (BigInt(y) - y1) * (x2 - x1), y2 - y1),
        at: Number(x1) + (y - Number(y1)) * Number(x2 - x1) / Number(y2 - y1),
        sum: `(${x} − ${signed(x1)})·${y2 - y1} − (${y} − ${signed(y1)})·${signed(x2 - x1)} = ${value < 0n ? `−${-value}` : value}`});
    });
    return list.sort((a, b) => a.at - b.at);
  };
  const covers = (polygon, x, y) => decisions(polygon, x, y).filter((d) => d.counts).length % 2 === 1;

  /// Calls use(x, y) for every sample of the frame that the polygon covers under lb. Exact below 2^26.
  const fill = (polygon, w, h, use) => {
    const ys = polygon.map((p) => p[1]);
    for (let y = Math.max(0, Math.min(...ys)); y < Math.min(h, Math.max(...ys)); ++y) {
      const row = [];
      polygon.forEach((p, i) => {
        let low = p, high = polygon[(i + 1) % polygon.length];
        if (low[1] > high[1]) [low, high] = [high, low];
        if (y < low[1] || y >= high[1]) return;
        const dy = high[1] - low[1], n = low[0] * dy + (y - low[1]) * (high[0] - low[0]);
        row.push(Math.ceil(n / dy));
      });
      row.sort((a, b) => a - b);
      for (let i = 0; i + 1 < row.length; i += 2) for (let x = Math.max(0, row[i]); x < Math.min(w, row[i + 1]); ++x) use(x, y);
    }
  };
  return {text, plane, decisions, covers, fill};
})();
