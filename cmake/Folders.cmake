# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# The folders of the program and what each may use: one target a folder. A file that includes a
# header of a folder that its own does not name ends the build with that line, before any compiler
# runs (CheckFolder.cmake). What is declared here is also what docs/architecture.md draws.

# weft_folder(<folder> [LEFT_OUT] [ONE_BY_ONE] [USES <folder...>] [EXCEPT <file...>]): the library
# of host/<folder>, a path such as scene/gltf, which is called weft_scene_gltf. Folders that it uses
# have to be declared before it, so that there are no circles. EXCEPT names sources that are no part
# of it; with LEFT_OUT none are. ONE_BY_ONE is for files that give the same name to like things.
function(weft_folder folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "LEFT_OUT;ONE_BY_ONE" "" "USES;EXCEPT")
  weft_folder_target("${folder}" target)
  set(sources "")
  if(NOT arg_LEFT_OUT)
    file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/host/${folder}/*.cpp")
  endif()
  foreach(file IN LISTS arg_EXCEPT)
    list(REMOVE_ITEM sources "${CMAKE_SOURCE_DIR}/host/${folder}/${file}")
  endforeach()
  weft_check_includes(${target}_includes host "${folder}" "${arg_USES}")
  if(sources)
    add_library(${target} STATIC ${sources})
    if(WEFT_CLANG_TIDY)
      set_target_properties(${target} PROPERTIES CXX_CLANG_TIDY "${WEFT_CLANG_TIDY};--quiet")
    endif()
    target_compile_options(${target} PRIVATE -Wpedantic) # not for kernels: they use vector extensions
    set(scope PUBLIC)
    weft_precompile_once(${target} host)
    if(NOT arg_ONE_BY_ONE)
      weft_compile_together(${target} 8)
    endif()
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_dependencies(${target} ${target}_includes)
  target_link_libraries(${target} ${scope} weft_host_options)
  foreach(used IN LISTS arg_USES)
    weft_folder_target("${used}" used_target)
    if(NOT TARGET ${used_target})
      message(FATAL_ERROR "host/${folder} uses ${used}, which is not declared before it")
    endif()
    target_link_libraries(${target} ${scope} ${used_target})
  endforeach()
  weft_draw_folder("${folder}" "${arg_USES}")
endfunction()

# weft_kernel_folder(<folder> [USES <folder...>]): the rule for the headers of kernels/<folder>. A
# kernel, which nothing includes, may use headers of all folders.
function(weft_kernel_folder folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "USES")
  weft_check_includes(weft_kernels_${folder}_includes kernels "${folder}" "${arg_USES}")
  foreach(used IN LISTS arg_USES)
    if(NOT TARGET weft_kernels_${used}_includes)
      message(FATAL_ERROR "kernels/${folder} uses ${used}, which is not declared before it")
    endif()
  endforeach()
  add_dependencies(weft_kernels weft_kernels_${folder}_includes)
endfunction()

function(weft_folder_target folder result)
  string(REPLACE "/" "_" name "${folder}")
  set(${result} "weft_${name}" PARENT_SCOPE)
endfunction()

# weft_check_includes(<target> <root> <folder> <uses>): a target that is built once <root>/<folder>
# includes nothing but headers of itself and of what it uses.
function(weft_check_includes target root folder uses)
  set(path "${CMAKE_SOURCE_DIR}/${root}/${folder}")
  file(GLOB files CONFIGURE_DEPENDS "${path}/*.h" "${path}/*.cpp" "${path}/*.def")
  set(stamp "${CMAKE_BINARY_DIR}/checks/${root}/${folder}.checked")
  set(list "${CMAKE_BINARY_DIR}/checks/${root}/${folder}.files")
  string(JOIN "\n" lines ${files})
  file(CONFIGURE OUTPUT "${list}" CONTENT "${lines}\n" @ONLY)
  string(JOIN "," allowed ${folder} ${uses})
  add_custom_command(
    OUTPUT "${stamp}"
    COMMAND "${CMAKE_COMMAND}" "-DSOURCE=${CMAKE_SOURCE_DIR}" "-DROOT=${root}"
            "-DFOLDER=${folder}" "-DALLOWED=${allowed}" "-DFILES=${list}" "-DSTAMP=${stamp}" -P
            "${CMAKE_SOURCE_DIR}/cmake/CheckFolder.cmake"
    DEPENDS ${files} "${list}" "${CMAKE_SOURCE_DIR}/cmake/CheckFolder.cmake"
    COMMENT "Checking what ${root}/${folder} includes"
    VERBATIM)
  add_custom_target(${target} ALL DEPENDS "${stamp}")
endfunction()

# weft_draw_folder(<folder> <uses>): adds the folder to the drawing, with an arrow to each folder
# that it uses, but for those that another one of them uses already.
function(weft_draw_folder folder uses)
  set(reached "")
  foreach(used IN LISTS uses)
    get_property(beyond GLOBAL PROPERTY "WEFT_REACHED_${used}")
    list(APPEND reached ${beyond})
  endforeach()
  string(REPLACE "/" "_" id "${folder}")
  set(drawn "    ${id}[\"${folder}\"]\n")
  foreach(used IN LISTS uses)
    if(NOT used IN_LIST reached)
      string(REPLACE "/" "_" used_id "${used}")
      string(APPEND drawn "    ${id} --> ${used_id}\n")
    endif()
  endforeach()
  set_property(GLOBAL APPEND_STRING PROPERTY WEFT_DRAWING "${drawn}")
  list(APPEND reached ${uses})
  list(REMOVE_DUPLICATES reached)
  set_property(GLOBAL PROPERTY "WEFT_REACHED_${folder}" "${reached}")
endfunction()

# weft_write_drawing(<file>): the folders as a Mermaid flowchart.
function(weft_write_drawing file)
  get_property(drawn GLOBAL PROPERTY WEFT_DRAWING)
  file(CONFIGURE OUTPUT "${file}" CONTENT "flowchart TD\n${drawn}" @ONLY)
endfunction()
