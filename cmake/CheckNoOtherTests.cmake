# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# Fails when PROGRAM, a Googletest executable, holds a test that FILTER does not select.
execute_process(
  COMMAND "${PROGRAM}" --gtest_list_tests "--gtest_filter=-${FILTER}"
  OUTPUT_VARIABLE tests
  RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests failed: ${status}")
endif()
string(REGEX REPLACE "Running main[^\n]*\n" "" tests "${tests}")
if(NOT tests STREQUAL "")
  message(FATAL_ERROR "These tests belong to no ctest entry:\n${tests}")
endif()
