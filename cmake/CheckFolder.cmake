# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# As a script: fails where a file of ROOT/FOLDER (FILES lists them, one a line) includes a header of
# a folder that is not in ALLOWED, a list with commas. Writes STAMP otherwise. ROOT is host or
# kernels; what host includes of any folder of kernels counts as kernels.
cmake_policy(SET CMP0057 NEW)
string(REPLACE "," ";" allowed "${ALLOWED}")
file(STRINGS "${FILES}" files)
set(failures "")
foreach(file IN LISTS files)
  file(RELATIVE_PATH name "${SOURCE}" "${file}")
  # In lines with brackets or semicolons CMake would see lists; only directives are read.
  file(STRINGS "${file}" includes REGEX "^[ \t]*#[ \t]*include[ \t]+\"[^\";]+\"")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE "^[^\"]*\"([^\"]+)\".*" "\\1" included "${line}")
    if(included MATCHES "\\.\\./")
      string(APPEND failures "${name} includes \"${included}\": files are named from the root\n")
      continue()
    endif()
    get_filename_component(folder "${included}" DIRECTORY)
    if(ROOT STREQUAL "kernels")
      string(REGEX REPLACE "^kernels/" "" folder "${folder}")
    elseif(folder MATCHES "^kernels(/|$)")
      set(folder kernels)
    endif()
    if(NOT folder STREQUAL "" AND NOT folder IN_LIST allowed)
      list(JOIN allowed ", " listed)
      string(APPEND failures "${name} includes \"${included}\", but ${ROOT}/${FOLDER} may use only "
             "${listed} (${ROOT}/CMakeLists.txt)\n")
    endif()
  endforeach()
endforeach()
if(failures)
  message(FATAL_ERROR "${failures}")
endif()
file(WRITE "${STAMP}" "")
