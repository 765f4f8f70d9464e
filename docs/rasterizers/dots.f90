! SPDX-License-Identifier: GPL-3.0-or-later
! A start in Fortran: one pixel per corner. Build (exports.map keeps the module's own names inside the library):
!   gfortran -O2 -fPIC -shared -Wl,--version-script=plugins/exports.map dots.f90 -o dots.so
! Bytes are signed here: iand(int(b), 255) is the number that a colour stands for.
module dots
  use, intrinsic :: iso_c_binding
  implicit none
  private

  type, bind(C) :: farop_vertex
    integer(c_int32_t) :: x, y, z
    integer(c_int8_t) :: rgb(3), reserved
  end type

  type, bind(C) :: farop_polygon  ! the members used here; more follow in memory
    integer(c_int32_t) :: struct_size, vertex_count
    type(c_ptr) :: vertices
  end type

  type, bind(C) :: farop_frame  ! likewise
    integer(c_int32_t) :: struct_size, width, height, subpixel_bits, z_near, z_far, max_vertices, number
    integer(c_int64_t) :: row_bytes
    type(c_ptr) :: pixels
  end type

  type, bind(C) :: farop_rasterizer  ! the whole table, as its size is told to the host
    integer(c_int32_t) :: struct_size, abi_version
    type(c_ptr) :: name, summary
    integer(c_int32_t) :: wants, reserved
    type(c_funptr) :: create, destroy, begin_frame, polygon, end_frame
  end type

  integer(c_int32_t), parameter :: FAROP_OK = 0, FAROP_ABI_VERSION = 65536

  type(farop_rasterizer), save, target :: table
  character(kind=c_char, len=64), save, target :: name = 'dots_f90' // c_null_char
  type(farop_frame), pointer :: frame => null()  ! no create(): all instances share this state
  integer(c_int8_t), pointer :: bytes(:) => null()

contains

  function entry_point(host) result(answer) bind(C, name='farop_rasterizer_entry')
    type(c_ptr), value :: host
    type(c_ptr) :: answer
    table = farop_rasterizer(int(c_sizeof(table), c_int32_t), FAROP_ABI_VERSION, c_loc(name), c_loc(name), 0, 0, &
                             c_null_funptr, c_null_funptr, c_funloc(begin_frame), c_funloc(polygon), &
                             c_funloc(end_frame))
    answer = merge(c_loc(table), c_null_ptr, c_associated(host))
  end function

  function begin_frame(self, f) result(status) bind(C)
    type(c_ptr), value :: self, f
    integer(c_int32_t) :: status
    call c_f_pointer(f, frame)
    ! The last row may end with its last pixel.
    call c_f_pointer(frame%pixels, bytes, [frame%row_bytes * (frame%height - 1) + 3 * frame%width])
    ! YOUR PART 3, beginning: the depth buffer. Keep one depth for each pixel, and set all of them farther than
    ! frame%z_far here, because every picture starts empty.
    status = FAROP_OK
  end function

  ! Any polygon, concave ones too. Only triangles come if the first 0 of the table below becomes 1.
  function polygon(self, p) result(status) bind(C)
    type(c_ptr), value :: self, p
    integer(c_int32_t) :: status
    type(farop_polygon), pointer :: poly
    type(farop_vertex), pointer :: corner(:)
    integer :: i
    call c_f_pointer(p, poly)
    call c_f_pointer(poly%vertices, corner, [poly%vertex_count])
    ! YOUR PART 1: scan conversion, in place of this loop. Enter the edges into a table by the row of their lower end;
    ! then, row by row upwards, the edges that cross a row, sorted by column, bound its spans in pairs. A sample on a
    ! left or bottom edge is inside and one on a right or top edge is not, so that neighbours share no pixel and leave
    ! none out.
    do i = 1, poly%vertex_count
      ! YOUR PART 2: interpolation. Depth and colour change by the same step from row to row along an edge, and from
      ! column to column along a span: compute the steps once, then add, and round to whole numbers last.
      call set_pixel(shifta(corner(i)%x, frame%subpixel_bits), shifta(corner(i)%y, frame%subpixel_bits), corner(i)%z, &
                     corner(i)%rgb)
    end do
    status = FAROP_OK
  end function

  ! Row 0 is the bottom row. Corners always lie on the frame, and so does all that lies between them.
  subroutine set_pixel(column, row, depth, rgb)
    integer(c_int32_t), intent(in) :: column, row, depth
    integer(c_int8_t), intent(in) :: rgb(3)
    integer(c_int64_t) :: before
    ! YOUR PART 3, end: the depth test. Leave the pixel alone unless depth is smaller than what is kept for it; if it
    ! is, keep it: whatever order the polygons come in, the nearest one is seen.
    before = row * frame%row_bytes + 3 * column
    bytes(before + 1:before + 3) = rgb
  end subroutine

  function end_frame(self) result(status) bind(C)
    type(c_ptr), value :: self
    integer(c_int32_t) :: status
    status = FAROP_OK
  end function
end module
