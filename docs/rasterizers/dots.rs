// SPDX-License-Identifier: GPL-3.0-or-later
// A start in Rust: one pixel per corner. Build: rustc -O --edition 2021 --crate-type cdylib dots.rs -o dots.so
use std::mem::size_of;
use std::os::raw::c_void;
use std::panic::{catch_unwind, AssertUnwindSafe};

// What this file uses of farop/rasterizer.h; the polygon and the frame go on in memory.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Vertex {
    x: i32,
    y: i32,
    z: i32,
    rgb: [u8; 3],
    reserved: u8,
}

#[repr(C)]
pub struct Polygon {
    struct_size: u32,
    vertex_count: u32,
    vertices: *const Vertex,
}

#[repr(C)]
pub struct Frame {
    struct_size: u32,
    width: i32,
    height: i32,
    subpixel_bits: i32,
    z_near: i32,
    z_far: i32,
    max_vertices: u32,
    number: u32,
    row_bytes: i64,
    pixels: *mut u8,
}

#[repr(C)]
pub struct Table {
    struct_size: u32,
    abi_version: u32,
    name: *const u8,
    summary: *const u8,
    wants: u32,
    reserved: u32,
    create: extern "C" fn(*const c_void, *mut *mut Rasterizer) -> i32,
    destroy: extern "C" fn(*mut Rasterizer),
    begin_frame: extern "C" fn(&mut Rasterizer, &'static Frame) -> i32,
    polygon: extern "C" fn(&mut Rasterizer, &Polygon) -> i32,
    end_frame: extern "C" fn(&mut Rasterizer) -> i32,
}
unsafe impl Sync for Table {}

const OK: i32 = 0;
const INTERNAL_ERROR: i32 = -4;

#[derive(Default)]
pub struct Rasterizer {
    frame: Option<&'static Frame>, // from begin_frame() to end_frame()
}

impl Rasterizer {
    fn begin_frame(&mut self, frame: &'static Frame) {
        self.frame = Some(frame);
        // YOUR PART 3, beginning: the depth buffer. Keep one depth for each pixel, and set all of them farther than
        // frame.z_far here, because every picture starts empty.
    }

    // Any polygon, concave ones too. Only triangles come if you set `wants` below to 1.
    fn polygon(&mut self, corners: &[Vertex]) {
        let bits = self.frame.unwrap().subpixel_bits;
        // YOUR PART 1: scan conversion, in place of this loop. Enter the edges into a table by the row of their lower
        // end; then, row by row upwards, the edges that cross a row, sorted by column, bound its spans in pairs. A
        // sample on a left or bottom edge is inside and one on a right or top edge is not, so that neighbours share no
        // pixel and leave none out.
        for v in corners {
            // YOUR PART 2: interpolation. Depth and colour change by the same step from row to row along an edge, and
            // from column to column along a span: compute the steps once, then add, and round to whole numbers last.
            self.set_pixel(v.x >> bits, v.y >> bits, v.z, v.rgb);
        }
    }

    // Row 0 is the bottom row. Corners always lie on the frame, and so does all that lies between them.
    fn set_pixel(&mut self, column: i32, row: i32, _depth: i32, rgb: [u8; 3]) {
        // YOUR PART 3, end: the depth test. Leave the pixel alone unless its depth is smaller than what is kept for it;
        // if it is, keep it: whatever order the polygons come in, the nearest one is seen.
        let frame = self.frame.unwrap();
        let offset = row as i64 * frame.row_bytes + 3 * column as i64;
        unsafe { frame.pixels.offset(offset as isize).cast::<[u8; 3]>().write(rgb) }
    }
}

// A panic that left one of these would end the host.
fn guarded(body: impl FnOnce()) -> i32 {
    catch_unwind(AssertUnwindSafe(body)).map_or(INTERNAL_ERROR, |_| OK)
}

extern "C" fn create(_host: *const c_void, state: *mut *mut Rasterizer) -> i32 {
    unsafe { *state = Box::into_raw(Box::default()) }
    OK
}

extern "C" fn destroy(state: *mut Rasterizer) {
    drop(unsafe { Box::from_raw(state) })
}

extern "C" fn begin_frame(state: &mut Rasterizer, frame: &'static Frame) -> i32 {
    guarded(|| state.begin_frame(frame))
}

extern "C" fn polygon(state: &mut Rasterizer, p: &Polygon) -> i32 {
    let corners = unsafe { std::slice::from_raw_parts(p.vertices, p.vertex_count as usize) };
    guarded(|| state.polygon(corners))
}

extern "C" fn end_frame(_dots: &mut Rasterizer) -> i32 {
    OK
}

static TABLE: Table = Table {
    struct_size: size_of::<Table>() as u32,
    abi_version: 1 << 16,
    name: b"dots_rs\0".as_ptr(),
    summary: b"one pixel per corner\0".as_ptr(), // your name, your algorithm
    wants: 0,
    reserved: 0,
    create,
    destroy,
    begin_frame,
    polygon,
    end_frame,
};

#[no_mangle]
pub extern "C" fn farop_rasterizer_entry(_host: *const c_void) -> *const Table {
    &TABLE
}
