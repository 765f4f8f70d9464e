// SPDX-License-Identifier: GPL-3.0-or-later
// A z-buffer for triangles in Zig. Build: zig build-lib -dynamic -lc -O ReleaseSafe -I plugins/include zbuffer.zig
const std = @import("std");
const c = @cImport(@cInclude("farop/rasterizer.h")); const V = c.farop_vertex;
const C: std.builtin.CallingConvention = if (@hasField(std.builtin.CallingConvention, "C")) .C else .c; // Zig 0.14
var frame: *const c.farop_frame = undefined;
var depth: []i32 = &.{};
fn beginFrame(_: ?*anyopaque, f: [*c]const c.farop_frame) callconv(C) c.farop_status {
    const count = @as(usize, @intCast(f.*.width)) * @as(usize, @intCast(f.*.height));
    depth = std.heap.c_allocator.realloc(depth, count) catch return c.FAROP_E_MEMORY;
    @memset(depth, std.math.maxInt(i32)); // beyond the far plane
    frame = f;
    return c.FAROP_OK;
}
// edge() > 0: (x, y) lies left of p -> q. lost(): samples on an edge up (a right one) or left (a top one).
fn edge(p: V, q: V, x: i32, y: i32) i64 { return @as(i64, q.x - p.x) * (y - p.y) - @as(i64, q.y - p.y) * (x - p.x); }
fn lost(p: V, q: V) i64 { return @intFromBool(p.y < q.y or (p.y == q.y and p.x > q.x)); }
fn real(n: anytype) f64 { return @floatFromInt(n); }
fn mix(w: [3]f64, v: [3]V, comptime field: []const u8) i32 {
    const a = real(@field(v[0], field)); const b = real(@field(v[1], field));
    return @intFromFloat(w[0] * a + w[1] * b + w[2] * real(@field(v[2], field)) + 0.5);
}
fn polygon(_: ?*anyopaque, p: [*c]const c.farop_polygon) callconv(C) c.farop_status {
    var v: [3]V = p.*.vertices[0..3].*;
    if (edge(v[0], v[1], v[2].x, v[2].y) < 0) std.mem.swap(V, &v[0], &v[1]); // counter-clockwise from here on
    const area = edge(v[0], v[1], v[2].x, v[2].y); const bits: u5 = @intCast(frame.subpixel_bits);
    var row = @min(v[0].y, v[1].y, v[2].y) >> bits;
    while (area != 0 and row <= @max(v[0].y, v[1].y, v[2].y) >> bits) : (row += 1) {
        var column = @min(v[0].x, v[1].x, v[2].x) >> bits;
        next: while (column <= @max(v[0].x, v[1].x, v[2].x) >> bits) : (column += 1) {
            var weights: [3]f64 = undefined;
            for (&weights, [3]usize{ 1, 2, 0 }, [3]usize{ 2, 0, 1 }) |*weight, i, j| {
                const w = edge(v[i], v[j], column << bits, row << bits);
                if (w < lost(v[i], v[j])) continue :next;
                weight.* = real(w) / real(area);
            }
            const nearest = &depth[@intCast(row * frame.width + column)]; const z = mix(weights, v, "z");
            if (z >= nearest.*) continue else nearest.* = z; // of equal depths the first drawn stays
            const rgb = frame.pixels + @as(usize, @intCast(row * frame.row_bytes + 3 * column));
            inline for (.{ "r", "g", "b" }, 0..) |channel, i| rgb[i] = @intCast(mix(weights, v, channel));
        }
    }
    return c.FAROP_OK;
}
fn endFrame(_: ?*anyopaque) callconv(C) c.farop_status { return c.FAROP_OK; }
const table = c.farop_rasterizer{ .struct_size = @sizeOf(c.farop_rasterizer), .name = "zbuffer_zig", .create = null,
    .abi_version = (c.FAROP_ABI_MAJOR << 16) | c.FAROP_ABI_MINOR, .summary = "z-buffer", .destroy = null, .reserved = 0,
    .wants = c.FAROP_WANT_TRIANGLES, .begin_frame = beginFrame, .polygon = polygon, .end_frame = endFrame };
export fn farop_rasterizer_entry(_: [*c]const c.farop_host) [*c]const c.farop_rasterizer { return &table; }
