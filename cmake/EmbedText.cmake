# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0

# weft_embed_text(<file>): generated/<its name>.inc is a string literal of the file's text, to be
# included where the program needs it, so that it looks up no path when it runs. A change of the
# file configures anew.
function(weft_embed_text file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" text)
  file(CONFIGURE OUTPUT "${WEFT_GENERATED_DIR}/${name}.inc" CONTENT "R\"text(@text@)text\"\n" @ONLY)
endfunction()
