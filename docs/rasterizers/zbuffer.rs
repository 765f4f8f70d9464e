// SPDX-License-Identifier: GPL-3.0-or-later
// A z-buffer in Rust, no crates. Build: rustc -O --edition 2021 --crate-type cdylib zbuffer.rs -o zbuffer_rs.so
use std::{mem::{size_of, swap}, os::raw::c_void, panic::{catch_unwind, AssertUnwindSafe}};
#[repr(C)] #[derive(Clone, Copy)] pub struct Vertex { x: i32, y: i32, z: i32, rgb: [u8; 3], reserved: u8 }
#[repr(C)] pub struct Polygon { struct_size: u32, vertex_count: u32, vertices: *const [Vertex; 3] } // and more
#[repr(C)] pub struct Frame { struct_size: u32, width: i32, height: i32, subpixel_bits: i32, z_near: i32, z_far: i32,
    max_vertices: u32, number: u32, row_bytes: i64, pixels: *mut u8 }
#[repr(C)] pub struct Table { size: u32, abi: u32, name: *const u8, summary: *const u8, wants: u32,
    reserved: u32, create: extern "C" fn(*const c_void, *mut *mut ZBuffer) -> i32, destroy: extern "C" fn(*mut ZBuffer),
    begin_frame: extern "C" fn(&mut ZBuffer, &'static Frame) -> i32,
    polygon: extern "C" fn(&mut ZBuffer, &Polygon) -> i32, end_frame: extern "C" fn(&mut ZBuffer) -> i32 }
unsafe impl Sync for Table {}
#[derive(Default)] pub struct ZBuffer { frame: Option<&'static Frame>, depth: Vec<i32> }
impl ZBuffer {
    fn draw(&mut self, [mut a, mut b, c]: [Vertex; 3]) {
        let f = self.frame.unwrap();
        // edge() > 0: (x, y) lies left of a -> b. lost(): samples on an edge up (a right one) or left (a top one).
        let cross = |x1: i32, y1: i32, x2: i32, y2: i32| x1 as i64 * y2 as i64 - y1 as i64 * x2 as i64;
        let edge = |a: Vertex, b: Vertex, x: i32, y: i32| cross(b.x - a.x, b.y - a.y, x - a.x, y - a.y);
        let lost = |a: Vertex, b: Vertex| (a.y < b.y || a.y == b.y && a.x > b.x) as i64;
        if edge(a, b, c.x, c.y) < 0 { swap(&mut a, &mut b) } // counter-clockwise from here on
        let (area, bits) = (edge(a, b, c.x, c.y), f.subpixel_bits); if area == 0 { return }
        for row in a.y.min(b.y).min(c.y) >> bits..=a.y.max(b.y).max(c.y) >> bits {
            for column in a.x.min(b.x).min(c.x) >> bits..=a.x.max(b.x).max(c.x) >> bits {
                let (x, y) = (column << bits, row << bits);
                let (u, v, w) = (edge(b, c, x, y), edge(c, a, x, y), edge(a, b, x, y));
                if u < lost(b, c) || v < lost(c, a) || w < lost(a, b) { continue }
                let [i, j, k] = [u, v, w].map(|weight| weight as f64 / area as f64);
                let z = (a.z as f64 * i + b.z as f64 * j + c.z as f64 * k + 0.5) as i32;
                let nearest = &mut self.depth[(row * f.width + column) as usize];
                if z >= *nearest { continue } // of equal depths the first drawn stays
                *nearest = z;
                let pixel = unsafe { f.pixels.add(row as usize * f.row_bytes as usize + 3 * column as usize) };
                let mix = |n: usize| (a.rgb[n] as f64 * i + b.rgb[n] as f64 * j + c.rgb[n] as f64 * k + 0.5) as u8;
                unsafe { pixel.cast::<[u8; 3]>().write([mix(0), mix(1), mix(2)]) }
            }
        }
    }
}
extern "C" fn create(_: *const c_void, s: *mut *mut ZBuffer) -> i32 { unsafe { *s = Box::into_raw(Box::default()) } 0 }
extern "C" fn destroy(s: *mut ZBuffer) { drop(unsafe { Box::from_raw(s) }) }
extern "C" fn begin_frame(s: &mut ZBuffer, f: &'static Frame) -> i32 {
    s.frame = Some(f); s.depth = vec![i32::MAX; (f.width * f.height) as usize]; 0 }
extern "C" fn polygon(s: &mut ZBuffer, p: &Polygon) -> i32 { // a panic that left here would end the host
    let v = unsafe { *p.vertices }; catch_unwind(AssertUnwindSafe(|| s.draw(v))).map_or(-4, |_| 0) }
extern "C" fn end_frame(_: &mut ZBuffer) -> i32 { 0 }
static TABLE: Table = Table { size: size_of::<Table>() as u32, abi: 1 << 16, wants: 1, reserved: 0, create, destroy,
    name: b"zbuffer_rs\0".as_ptr(), summary: b"z-buffer in Rust\0".as_ptr(), begin_frame, polygon, end_frame };
#[no_mangle] pub extern "C" fn farop_rasterizer_entry(_: *const c_void) -> *const Table { &TABLE }
