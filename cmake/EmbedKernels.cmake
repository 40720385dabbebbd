# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# As a module: weft_embed_kernels(<target>) compiles every file of kernels/ and its subfolders into
# the target as text, so that the program looks up no path when it runs
# (host/device/kernel_sources.h). A file is named by its path relative to kernels/, as in #include.
# As a script: cmake -DKERNEL_FOLDER=<folder> -DKERNEL_LIST=<file> -DOUTPUT=<file> -P
# EmbedKernels.cmake writes that source.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(weft_embed_script "${CMAKE_CURRENT_LIST_FILE}")

  function(weft_embed_kernels target)
    set(folder "${CMAKE_SOURCE_DIR}/kernels")
    file(GLOB kernels CONFIGURE_DEPENDS "${folder}/*/*.h" "${folder}/*/*.cl" "${folder}/*/*.def")
    set(output "${WEFT_GENERATED_DIR}/kernel_sources.cpp")
    # The list itself is a dependency: a deleted kernel must not stay in the program.
    set(list_file "${WEFT_GENERATED_DIR}/kernel_files.txt")
    file(CONFIGURE OUTPUT "${list_file}" CONTENT "${kernels}" @ONLY)
    add_custom_command(
      OUTPUT "${output}"
      COMMAND "${CMAKE_COMMAND}" "-DKERNEL_FOLDER=${folder}" "-DKERNEL_LIST=${list_file}"
              "-DOUTPUT=${output}" -P "${weft_embed_script}"
      DEPENDS ${kernels} "${list_file}" "${weft_embed_script}"
      COMMENT "Embedding kernel sources"
      VERBATIM)
    target_sources(${target} PRIVATE "${output}")
  endfunction()
  return()
endif()

file(READ "${KERNEL_LIST}" kernels)
set(arrays "")
set(entries "")
set(count 0)
foreach(kernel IN LISTS kernels)
  # OpenCL C sources are ASCII, and a char above 0x7f would not fit the array either.
  file(READ "${kernel}" text)
  if(text MATCHES "[^\t\r\n -~]")
    string(FIND "${text}" "${CMAKE_MATCH_0}" offset)
    message(FATAL_ERROR "${kernel}: byte ${offset} is not ASCII; kernel sources must be")
  endif()
  file(READ "${kernel}" bytes HEX)
  # Sixteen bytes per line; integers rather than a literal, so no length limit applies.
  string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  file(RELATIVE_PATH name "${KERNEL_FOLDER}" "${kernel}")
  string(APPEND arrays "// ${name}\nconstexpr char text_${count}[] = {\n${bytes}0x00};\n\n")
  string(APPEND entries
         "    KernelSource{\"${name}\", {text_${count}, sizeof text_${count} - 1}},\n")
  math(EXPR count "${count} + 1")
endforeach()

file(
  WRITE "${OUTPUT}"
  "// Generated from kernels/ by cmake/EmbedKernels.cmake.\n"
  "#include \"device/kernel_sources.h\"\n\n"
  "#include <array>\n\n"
  "namespace weft {\nnamespace {\n\n"
  "${arrays}"
  "constexpr std::array<KernelSource, ${count}> sources = {\n${entries}};\n\n"
  "}  // namespace\n\n"
  "std::span<const KernelSource> kernel_sources() { return sources; }\n\n"
  "}  // namespace weft\n")
