! SPDX-License-Identifier: GPL-3.0-or-later
! A z-buffer for triangles in Fortran. Build (exports.map keeps the module's own names inside the library):
!   gfortran -O2 -fPIC -shared -Wl,--version-script=plugins/exports.map zbuffer.f90 -o zbuffer.so
module zbuffer
  use, intrinsic :: iso_c_binding, i4 => c_int32_t, i8 => c_int64_t, r8 => c_double; implicit none
  type, bind(C) :: farop_vertex; integer(i4) :: x, y, z; integer(c_int8_t) :: rgb(3), reserved; end type
  type, bind(C) :: farop_polygon; integer(i4) :: struct_size, count; type(c_ptr) :: vertices; end type  ! and more
  type, bind(C) :: farop_frame; integer(i4) :: struct_size, width, height, bits, z_near, z_far, max_vertices, number
    integer(i8) :: row_bytes; type(c_ptr) :: pixels; end type
  type, bind(C) :: farop_rasterizer; integer(i4) :: struct_size, abi_version; type(c_ptr) :: name, summary
    integer(i4) :: wants, reserved; type(c_funptr) :: create, destroy, begin_frame, polygon, end_frame; end type
  character(kind=c_char, len=64), save, target :: name = 'zbuffer_f90' // c_null_char
  type(farop_rasterizer), save, target :: table; type(farop_frame), pointer :: frame
  integer(c_int8_t), pointer :: bytes(:); integer(i4), allocatable :: depth(:, :)
contains
  integer(i4) function begin_frame(self, f) bind(C); type(c_ptr), value :: self, f
    call c_f_pointer(f, frame)
    call c_f_pointer(frame%pixels, bytes, [frame%row_bytes * (frame%height - 1) + 3 * frame%width])
    if (allocated(depth)) deallocate (depth)
    allocate (depth(0:frame%width - 1, 0:frame%height - 1), source=huge(1_i4), stat=begin_frame)  ! beyond the far plane
    begin_frame = merge(0, -1, begin_frame == 0)
  end function
  integer(i4) function polygon(self, p) bind(C); type(c_ptr), value :: self, p
    type(farop_polygon), pointer :: poly; type(farop_vertex), pointer :: v(:)
    integer(i8) :: x(3), y(3), dx(3), dy(3), w(3), area, row, column, at
    integer :: i(3), j(3), z; real(r8) :: part(3), rgb(3, 3)
    call c_f_pointer(p, poly); call c_f_pointer(poly%vertices, v, [3]); x = v%x; y = v%y; polygon = 0
    area = (x(2) - x(1)) * (y(3) - y(1)) - (y(2) - y(1)) * (x(3) - x(1)); if (area == 0) return
    i = merge([2, 3, 1], [3, 1, 2], area > 0); j = 6 - i - [1, 2, 3]  ! edges i -> j run counter-clockwise
    dx = x(j) - x(i); dy = y(j) - y(i); rgb = reshape(iand(int([v(1)%rgb, v(2)%rgb, v(3)%rgb]), 255), [3, 3])
    do row = shifta(minval(y), frame%bits), shifta(maxval(y), frame%bits)
      do column = shifta(minval(x), frame%bits), shifta(maxval(x), frame%bits)
        w = dx * (shiftl(row, frame%bits) - y(i)) - dy * (shiftl(column, frame%bits) - x(i))  ! > 0: left of the edge
        ! Samples on an edge that goes up (a right one) or, level, to the left (a top one) are the neighbour's.
        if (any(w < 0 .or. (w == 0 .and. (dy > 0 .or. (dy == 0 .and. dx < 0))))) cycle
        part = real(w, r8) / abs(area); z = int(dot_product(part, v%z) + 0.5)
        if (z >= depth(column, row)) cycle  ! of equal depths the first drawn stays
        depth(column, row) = z; at = row * frame%row_bytes + 3 * column
        bytes(at + 1:at + 3) = int(modulo(int(matmul(rgb, part) + 0.5) + 128, 256) - 128, c_int8_t)  ! 255 is -1
      end do
    end do
  end function
  integer(i4) function end_frame(self) bind(C); type(c_ptr), value :: self; end_frame = 0; end function
  type(c_ptr) function entry_point(host) bind(C, name='farop_rasterizer_entry'); type(c_ptr), value :: host
    table = farop_rasterizer(int(c_sizeof(table), i4), 65536, c_loc(name), c_loc(name), 1, 0, c_null_funptr, &
                             c_null_funptr, c_funloc(begin_frame), c_funloc(polygon), c_funloc(end_frame))
    entry_point = c_loc(table)
  end function
end module
