# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# Finds Embree 4 or, failing that, Embree 3. Sets EmbreeAny_FOUND and EMBREE_ANY_MAJOR (4 or 3) and
# makes the target EmbreeAny::EmbreeAny, which defines WEFT_EMBREE_MAJOR for its users.
foreach(major IN ITEMS 4 3)
  find_path(EMBREE${major}_INCLUDE_DIR embree${major}/rtcore.h)
  find_library(EMBREE${major}_LIBRARY embree${major})
  mark_as_advanced(EMBREE${major}_INCLUDE_DIR EMBREE${major}_LIBRARY)
  if(EMBREE${major}_INCLUDE_DIR AND EMBREE${major}_LIBRARY)
    set(EMBREE_ANY_MAJOR ${major})
    break()
  endif()
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(EmbreeAny REQUIRED_VARS EMBREE_ANY_MAJOR)

if(EmbreeAny_FOUND AND NOT TARGET EmbreeAny::EmbreeAny)
  add_library(EmbreeAny::EmbreeAny UNKNOWN IMPORTED)
  set_target_properties(
    EmbreeAny::EmbreeAny
    PROPERTIES IMPORTED_LOCATION "${EMBREE${EMBREE_ANY_MAJOR}_LIBRARY}"
               INTERFACE_INCLUDE_DIRECTORIES "${EMBREE${EMBREE_ANY_MAJOR}_INCLUDE_DIR}"
               INTERFACE_COMPILE_DEFINITIONS "WEFT_EMBREE_MAJOR=${EMBREE_ANY_MAJOR}")
endif()
