# SPDX-License-Identifier: GPL-3.0-or-later
# Tcl 8.6 as Tcl::tcl. CMake's own module also looks for wish and Tk, which nobody here needs.
find_path(FAROP_TCL_INCLUDE_DIR tcl.h PATH_SUFFIXES tcl8.6 REQUIRED)
find_library(FAROP_TCL_LIBRARY NAMES tcl8.6 tcl86 REQUIRED)
mark_as_advanced(FAROP_TCL_INCLUDE_DIR FAROP_TCL_LIBRARY)
if(NOT TARGET Tcl::tcl)
  add_library(Tcl::tcl UNKNOWN IMPORTED)
  set_target_properties(Tcl::tcl PROPERTIES IMPORTED_LOCATION "${FAROP_TCL_LIBRARY}"
                        INTERFACE_INCLUDE_DIRECTORIES "${FAROP_TCL_INCLUDE_DIR}")
endif()
