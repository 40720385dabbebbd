# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What `make_scenes.py` is made of: solids, texture images, colours, the glTF writer and the scenes."""
