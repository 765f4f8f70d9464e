FFLAGS ?= -O2 -g -Wall -Wno-unused-dummy-argument
BUILT = @LIBRARY@ exports.map *.mod

@LIBRARY@: @FILE@ Makefile exports.map
	gfortran $(FFLAGS) -fPIC -shared -Wl,--version-script=exports.map @FILE@ -o $@

# Keeps the names of the module inside the library: two rasterizers may have a subroutine of the same name.
exports.map: Makefile
	echo '{ global: farop_rasterizer_entry; local: *; };' > $@
