# SPDX-License-Identifier: GPL-3.0-or-later
# Debian 12's OpenImageIO names the include folder of a library that it does not pull in (OpenCV); CMake insists that
# the folder exists. Included after find_package(OpenImageIO), here and by whoever uses the installed libraries.
get_target_property(_oiio_folders OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
set(_existing_folders)
foreach(_folder IN LISTS _oiio_folders)
  if(EXISTS "${_folder}")
    list(APPEND _existing_folders "${_folder}")
  endif()
endforeach()
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${_existing_folders}")
