// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/svg_plot.h"

namespace weft {

// The colours of series are those of Okabe and Ito, the faint ones darker on white and the dark
// ones lighter on black. Print is light.
std::string_view plot_style() {
    return R"(
:root { color-scheme: light dark; --paper: #ffffff; --panel: #f5f6f8; --ink: #1c2024;
  --muted: #5b6470; --rule: #d5d9df; --grid: #e6e8ec; --accent: #005a9c;
  --series-0: #0072b2; --series-1: #d55e00; --series-2: #009e73; --series-3: #b8598f;
  --series-4: #c98a00; --series-5: #3a9bd4; --series-6: #857500; --series-7: #5a5a5a; }
@media screen and (prefers-color-scheme: dark) {
:root { --paper: #15181c; --panel: #1e2228; --ink: #e8eaed; --muted: #a3abb6; --rule: #3a414a;
  --grid: #2a3038; --accent: #7cc0f5;
  --series-0: #4aa3df; --series-1: #f07f3c; --series-2: #2fc79b; --series-3: #e29cc4;
  --series-4: #f0b429; --series-5: #9ad4f7; --series-6: #f0e442; --series-7: #b9bec6; } }
.plot { display: block; width: 100%; height: auto; font: 12px/1 system-ui, sans-serif; }
.plot text { fill: var(--ink); }
.plot .plot-title { font-size: 13px; font-weight: 600; }
.plot .plot-tick, .plot .plot-note { fill: var(--muted); font-size: 11px; }
.plot .plot-note { paint-order: stroke; stroke: var(--paper); stroke-width: 3px;
  stroke-linejoin: round; }
.plot .plot-grid { stroke: var(--rule); stroke-width: 1; }
.plot .plot-fine { stroke: var(--grid); stroke-width: 1; }
.plot .plot-axis { fill: none; stroke: var(--muted); stroke-width: 1; }
.plot .plot-level { stroke: var(--ink); stroke-width: 1.2; stroke-dasharray: 6 4; }
.plot .plot-line { fill: none; stroke: var(--series); stroke-width: 1.8;
  stroke-linejoin: round; }
.plot .plot-bar { fill: none; stroke: var(--series); stroke-width: 1.1; opacity: 0.55; }
.plot .plot-point { fill: var(--series); stroke: var(--paper); stroke-width: 0.8; }
.plot .plot-hollow { fill: var(--paper); stroke: var(--series); stroke-width: 1.8; }
.plot .plot-ring { fill: none; stroke: var(--ink); stroke-width: 1.4; }
.plot .series-0 { --series: var(--series-0); } .plot .series-1 { --series: var(--series-1); }
.plot .series-2 { --series: var(--series-2); } .plot .series-3 { --series: var(--series-3); }
.plot .series-4 { --series: var(--series-4); } .plot .series-5 { --series: var(--series-5); }
.plot .series-6 { --series: var(--series-6); } .plot .series-7 { --series: var(--series-7); }
.plot .series-neutral { --series: var(--ink); }
)";
}

}  // namespace weft
