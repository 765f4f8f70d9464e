// SPDX-License-Identifier: GPL-3.0-or-later
// A start in Zig: one pixel per corner. Build: zig build-lib -dynamic -lc -O ReleaseSafe -I plugins/include dots.zig
// The C header itself is imported, so types and names cannot drift away from it.
const std = @import("std");
const c = @cImport(@cInclude("farop/rasterizer.h"));

/// The C calling convention was renamed in Zig 0.14.
const C: std.builtin.CallingConvention = if (@hasField(std.builtin.CallingConvention, "C")) .C else .c;

const Dots = struct {
    host: *const c.farop_host,
    frame: *const c.farop_frame = undefined, // from begin_frame() to end_frame()
};

fn instance(self: ?*anyopaque) *Dots {
    return @ptrCast(@alignCast(self));
}

fn create(host: [*c]const c.farop_host, self: [*c]?*anyopaque) callconv(C) c.farop_status {
    const dots = std.heap.c_allocator.create(Dots) catch return c.FAROP_E_MEMORY;
    dots.* = .{ .host = host };
    self.* = dots;
    return c.FAROP_OK;
}

fn destroy(self: ?*anyopaque) callconv(C) void {
    std.heap.c_allocator.destroy(instance(self));
}

fn beginFrame(self: ?*anyopaque, frame: [*c]const c.farop_frame) callconv(C) c.farop_status {
    instance(self).frame = frame;
    return c.FAROP_OK;
}

// Corners always lie on the frame: no bounds to check. Row 0 is the bottom row.
fn polygon(self: ?*anyopaque, p: [*c]const c.farop_polygon) callconv(C) c.farop_status {
    const frame = instance(self).frame;
    for (p.*.vertices[0..p.*.vertex_count]) |corner| {
        const column: usize = @intCast(corner.x >> @intCast(frame.subpixel_bits));
        const row: usize = @intCast(corner.y >> @intCast(frame.subpixel_bits));
        const pixel = frame.pixels + row * @as(usize, @intCast(frame.row_bytes)) + 3 * column;
        pixel[0] = corner.r;
        pixel[1] = corner.g;
        pixel[2] = corner.b;
    }
    return c.FAROP_OK;
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
