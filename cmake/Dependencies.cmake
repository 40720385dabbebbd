# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# weft_dependencies: every library of the host program, as Debian 12 and 13 package them. All that
# is missing is reported at once, by the name of its Debian package.
add_library(weft_dependencies INTERFACE)
set(weft_missing_packages "")

# weft_require_package(<Debian package> <CMake package> <target> [find_package arguments...])
function(weft_require_package debian_package package target)
  find_package(${package} QUIET ${ARGN})
  if(TARGET ${target})
    target_link_libraries(weft_dependencies INTERFACE ${target})
  else()
    set(weft_missing_packages "${weft_missing_packages} ${debian_package}" PARENT_SCOPE)
  endif()
endfunction()

# weft_require_header(<Debian package> <header>): for header libraries.
function(weft_require_header debian_package header)
  string(MAKE_C_IDENTIFIER "${debian_package}" name)
  find_path(WEFT_${name}_INCLUDE_DIR "${header}")
  mark_as_advanced(WEFT_${name}_INCLUDE_DIR)
  if(WEFT_${name}_INCLUDE_DIR)
    target_include_directories(
      weft_dependencies SYSTEM INTERFACE "${WEFT_${name}_INCLUDE_DIR}")
  else()
    set(weft_missing_packages "${weft_missing_packages} ${debian_package}" PARENT_SCOPE)
  endif()
endfunction()

set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
target_link_libraries(weft_dependencies INTERFACE Threads::Threads)

weft_require_package(libembree-dev EmbreeAny EmbreeAny::EmbreeAny)
weft_require_package(libtbb-dev TBB TBB::tbb CONFIG)
weft_require_package(libopenexr-dev OpenEXR OpenEXR::OpenEXR CONFIG)
weft_require_package(libfmt-dev fmt fmt::fmt CONFIG)
weft_require_package(nlohmann-json3-dev nlohmann_json nlohmann_json::nlohmann_json CONFIG)
weft_require_package(libpugixml-dev pugixml pugixml::pugixml CONFIG)
weft_require_package(libpng-dev PNG PNG::PNG)
weft_require_package(libjpeg-dev JPEG JPEG::JPEG)
weft_require_package(zlib1g-dev ZLIB ZLIB::ZLIB)
weft_require_package(libblosc-dev Blosc Blosc::blosc)
weft_require_header(libnanovdb-dev nanovdb/NanoVDB.h)
weft_require_header(libkissfft-dev kissfft/kissfft.hh)
weft_require_header(libglm-dev glm/glm.hpp)
weft_require_header(libcli11-dev CLI/CLI.hpp)
weft_require_header(libboost-dev boost/beast.hpp)
weft_require_header(libkainjow-mustache-dev kainjow/mustache.hpp)
weft_require_header(libstb-dev stb/stb_image.h) # compiled into Weft with its own settings
if(WEFT_OPENCL)
  weft_require_package(ocl-icd-opencl-dev OpenCL OpenCL::OpenCL)
  weft_require_header(opencl-clhpp-headers CL/opencl.hpp)
endif()
if(WEFT_TESTS)
  find_package(GTest QUIET CONFIG)
  if(NOT TARGET GTest::gtest_main)
    message(STATUS "GoogleTest (libgtest-dev) is not there: Weft is built without its tests")
    set(WEFT_TESTS OFF)
  endif()
endif()

if(weft_missing_packages)
  message(
    FATAL_ERROR
      "Some libraries were not found. On Debian 12 or 13 this installs them:\n"
      "  apt-get install${weft_missing_packages}\n"
      "Without the OpenCL packages, -DWEFT_OPENCL=OFF builds the native backend alone.")
endif()
