// SPDX-License-Identifier: GPL-3.0-or-later
// A start in Zig: one pixel per corner. Build: zig build-lib -dynamic -lc -O ReleaseSafe -I plugins/include dots.zig
// The C header itself is imported, so types and names cannot drift away from it.
const std = @import("std");
const c = @cImport(@cInclude("farop/rasterizer.h"));

/// The C calling convention was renamed in Zig 0.14.
const C: std.builtin.CallingConvention = if (@hasField(std.builtin.CallingConvention, "C")) .C else .c;

const Rasterizer = struct {
    host: *const c.farop_host,
    frame: *const c.farop_frame = undefined, // from begin_frame() to end_frame()
};

fn instance(self: ?*anyopaque) *Rasterizer {
    return @ptrCast(@alignCast(self));
}

fn create(host: [*c]const c.farop_host, self: [*c]?*anyopaque) callconv(C) c.farop_status {
    const state = std.heap.c_allocator.create(Rasterizer) catch return c.FAROP_E_MEMORY;
    state.* = .{ .host = host };
    self.* = state;
    return c.FAROP_OK;
}

fn destroy(self: ?*anyopaque) callconv(C) void {
    std.heap.c_allocator.destroy(instance(self));
}

fn beginFrame(self: ?*anyopaque, frame: [*c]const c.farop_frame) callconv(C) c.farop_status {
    instance(self).frame = frame;
    // YOUR PART 3, beginning: the depth buffer. Keep one depth for each pixel, and set all of them farther than
    // frame.z_far here, because every picture starts empty.
    return c.FAROP_OK;
}

// Any polygon, concave ones too. Only triangles come if you set `wants` below to c.FAROP_WANT_TRIANGLES.
fn polygon(self: ?*anyopaque, p: [*c]const c.farop_polygon) callconv(C) c.farop_status {
    const state = instance(self);
    // YOUR PART 1: scan conversion, in place of this loop. Enter the edges into a table by the row of their lower end;
    // then, row by row upwards, the edges that cross a row, sorted by column, bound its spans in pairs. A sample on a
    // left or bottom edge is inside and one on a right or top edge is not, so that neighbours share no pixel and leave
    // none out.
    for (p.*.vertices[0..p.*.vertex_count]) |corner| {
        const column: usize = @intCast(corner.x >> @intCast(state.frame.subpixel_bits));
        const row: usize = @intCast(corner.y >> @intCast(state.frame.subpixel_bits));
        // YOUR PART 2: interpolation. Depth and colour change by the same step from row to row along an edge, and from
        // column to column along a span: compute the steps once, then add, and round to whole numbers last.
        setPixel(state, column, row, corner.z, .{ corner.r, corner.g, corner.b });
    }
    return c.FAROP_OK;
}

// Row 0 is the bottom row. Corners always lie on the frame, and so does all that lies between them.
fn setPixel(state: *Rasterizer, column: usize, row: usize, depth: i32, rgb: [3]u8) void {
    // YOUR PART 3, end: the depth test. Leave the pixel alone unless depth is smaller than what is kept for it; if it
    // is, keep it: whatever order the polygons come in, the nearest one is seen.
    _ = depth;
    const pixel = state.frame.pixels + row * @as(usize, @intCast(state.frame.row_bytes)) + 3 * column;
    pixel[0] = rgb[0];
    pixel[1] = rgb[1];
    pixel[2] = rgb[2];
}

fn endFrame(_: ?*anyopaque) callconv(C) c.farop_status {
    return c.FAROP_OK;
}

const table = c.farop_rasterizer{
    .struct_size = @sizeOf(c.farop_rasterizer),
    .abi_version = (c.FAROP_ABI_MAJOR << 16) | c.FAROP_ABI_MINOR,
    .name = "dots_zig",
    .summary = "one pixel per corner",
    .wants = 0,
    .reserved = 0,
    .create = create,
    .destroy = destroy,
    .begin_frame = beginFrame,
    .polygon = polygon,
    .end_frame = endFrame,
};

export fn farop_rasterizer_entry(_: [*c]const c.farop_host) [*c]const c.farop_rasterizer {
    return &table;
}
