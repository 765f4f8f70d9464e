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
             share/farop/templates/Makefile share/farop/rasterizers/dots.c)
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
# PNG: the picture library is found in the installation.
must(${WORK}/prefix/bin/farop render ${WORK}/prefix/share/farop/scenes/hollow-cube.nff -o ${WORK}/cube.png)
must(${WORK}/prefix/bin/farop info ${WORK}/prefix/share/farop/scenes/solid-torus.nff)
# A rasterizer of one's own: its templates and the header are found in the installation.
must(${WORK}/prefix/bin/farop new ${WORK}/mine --lang c)
must(make -C ${WORK}/mine FAROP=${WORK}/prefix/bin/farop picture)
