# SPDX-License-Identifier: GPL-3.0-or-later
function(must)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGV}\n${out}")
  endif()
  set(must_output "${out}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
must(${CMAKE_COMMAND} --install ${FAROP_BUILD} --prefix ${WORK}/prefix)
foreach(file bin/farop share/man/man1/farop.1 share/bash-completion/completions/farop share/zsh/site-functions/_farop
             share/fish/vendor_completions.d/farop.fish share/farop/scenes/hollow-cube.nff include/farop/rasterizer.h
             share/farop/scenes/sipp/grove.sipp share/farop/scenes/sipp/tree.tcl
             share/farop/templates/Makefile share/farop/rasterizers/dots.c include/farop-sipp/sipp.h
             include/farop/parse_sipp/parse_sipp.h)
  if(NOT EXISTS ${WORK}/prefix/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
must(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${WORK}/prefix
     -D CMAKE_CXX_COMPILER=${COMPILER} -D SANITIZE=${SANITIZE})
must(${CMAKE_COMMAND} --build ${WORK}/build)
must(${WORK}/build/consumer ${WORK}/prefix/share/farop/scenes/hollow-cube.nff)
if(NOT must_output STREQUAL "128 polygons\n")
  message(FATAL_ERROR "the consumer printed: ${must_output}")
endif()
# A script that sources a file beside it, in the consumer, which needs Tcl, and in the program.
set(grove ${WORK}/prefix/share/farop/scenes/sipp/grove.sipp)
must(${WORK}/build/consumer ${grove})
if(NOT must_output STREQUAL "93660 polygons\n")
  message(FATAL_ERROR "the consumer printed: ${must_output}")
endif()
must(${WORK}/prefix/bin/farop render ${grove} -o ${WORK}/grove.png --resolution 160x120)
# PNG: the picture library is found in the installation.
must(${WORK}/prefix/bin/farop render ${WORK}/prefix/share/farop/scenes/hollow-cube.nff -o ${WORK}/cube.png)
must(${WORK}/prefix/bin/farop info ${WORK}/prefix/share/farop/scenes/solid-torus.nff)
# A rasterizer of one's own: its templates and the header are found in the installation.
must(${WORK}/prefix/bin/farop new ${WORK}/mine --lang c)
must(make -C ${WORK}/mine FAROP=${WORK}/prefix/bin/farop picture)
# A program written for SIPP: as the consumer's target, and by one command of pkg-config and the C compiler.
must(${CMAKE_COMMAND} -E env ASAN_OPTIONS=detect_leaks=0 ${CMAKE_COMMAND} -E chdir ${WORK} ${WORK}/build/old_program -s 32)
file(SIZE ${WORK}/torus.ppm bytes)
if(bytes LESS 3072)
  message(FATAL_ERROR "the picture of the old program has ${bytes} bytes")
endif()
find_program(PKG_CONFIG pkg-config)
file(GLOB_RECURSE sipp_pc ${WORK}/prefix/*/sipp.pc)
if(PKG_CONFIG AND NOT SANITIZE)
  get_filename_component(folder ${sipp_pc} DIRECTORY)
  must(${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${folder} ${PKG_CONFIG} --cflags --libs sipp)
  separate_arguments(flags UNIX_COMMAND "${must_output}")
  must(${C_COMPILER} -std=gnu89 -w ${SOURCE}/../../sipp_api/programs/torus.c ${flags} -o ${WORK}/torus)
  must(${CMAKE_COMMAND} -E chdir ${WORK} ${WORK}/torus -s 64)
  file(SIZE ${WORK}/torus.ppm bytes)
  if(bytes LESS 12288)
    message(FATAL_ERROR "the picture of the program that pkg-config linked has ${bytes} bytes")
  endif()
endif()
