# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# weft_test_suites(<file> <stem> <result>): the names of the Googletest suites of a file. Configuring
# stops where one does not begin with the CamelCase of the file's stem, or where there is none.
function(weft_test_suites file stem result)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  string(REPLACE "_" ";" words "${stem}")
  set(prefix "")
  foreach(word IN LISTS words)
    string(SUBSTRING "${word}" 0 1 first)
    string(SUBSTRING "${word}" 1 -1 rest)
    string(TOUPPER "${first}" first)
    string(APPEND prefix "${first}${rest}")
  endforeach()

  file(READ "${file}" text)
  string(REGEX MATCHALL "(^|\n)[ \t]*(TYPED_TEST|TEST)(_F|_P)?[ \t\n]*\\([ \t\n]*[A-Za-z0-9_]+" tests
         "${text}")
  set(suites "")
  foreach(test IN LISTS tests)
    string(REGEX REPLACE ".*\\([ \t\n]*" "" suite "${test}")
    if(NOT suite MATCHES "^${prefix}")
      message(FATAL_ERROR "${file}: the test suite ${suite} must be named ${prefix}...")
    endif()
    list(APPEND suites ${suite})
  endforeach()
  list(REMOVE_DUPLICATES suites)
  if(NOT suites)
    message(FATAL_ERROR "${file}: holds no test; expected TEST(${prefix}..., ...)")
  endif()
  set(${result} "${suites}" PARENT_SCOPE)
endfunction()

# weft_gtest_filter(<suites> <result>): a --gtest_filter value for these suites, plain, typed
# (Suite/0.Name) and parameterised (Prefix/Suite.Name/0).
function(weft_gtest_filter suites result)
  set(patterns "")
  foreach(suite IN LISTS suites)
    list(APPEND patterns "${suite}.*" "${suite}/*" "*/${suite}.*" "*/${suite}/*")
  endforeach()
  string(REPLACE ";" ":" patterns "${patterns}")
  set(${result} "${patterns}" PARENT_SCOPE)
endfunction()
