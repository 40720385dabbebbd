# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# Fails when one of the OBJECTS, the natively compiled kernels, defines a weak or public symbol
# outside its own namespace weft_native_*. NM is the nm program.
if(NOT OBJECTS)
  message(FATAL_ERROR "No objects to check")
endif()
foreach(object IN LISTS OBJECTS)
  execute_process(
    COMMAND "${NM}" --defined-only --extern-only "${object}"
    OUTPUT_VARIABLE symbols
    COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" lines "${symbols}")
  foreach(line IN LISTS lines)
    # Weak data that any variant may provide: references to personality routines, and information
    # about types, which clang++ writes for the sanitizer of undefined behaviour.
    if(NOT line MATCHES "weft_native_" AND NOT line MATCHES "DW\\.ref\\."
       AND NOT line MATCHES " V _ZT[IS]")
      message(SEND_ERROR "${object} defines a symbol that other code shares: ${line}")
    endif()
  endforeach()
endforeach()
