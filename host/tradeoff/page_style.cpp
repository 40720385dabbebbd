// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/page_style.h"

namespace weft {

std::string_view page_style() {
    return R"(
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1290px; padding: 2rem 1.5rem 4rem; background: var(--paper);
  color: var(--ink); font: 16px/1.55 system-ui, -apple-system, "Segoe UI", sans-serif; }
h1 { font-size: 1.8rem; line-height: 1.2; margin: 0 0 0.4rem; overflow-wrap: anywhere; }
h2 { font-size: 1.3rem; margin: 2.8rem 0 0.6rem; padding-top: 0.9rem;
  border-top: 1px solid var(--rule); }
h3 { font-size: 1.05rem; margin: 1.8rem 0 0.5rem; }
p { max-width: 46rem; margin: 0.5rem 0; }
.lead { color: var(--muted); }
pre { background: var(--panel); border-left: 3px solid var(--accent); margin: 0.4rem 0;
  padding: 0.5rem 0.8rem; white-space: pre-wrap; overflow-wrap: anywhere; }
code { font: 0.88em/1.45 ui-monospace, "DejaVu Sans Mono", monospace; }
.answers { list-style: none; margin: 1rem 0; padding: 0; }
.answers li { margin: 0 0 1.1rem; }
.answers p { font-size: 1.1rem; }
figure { margin: 0.8rem 0; break-inside: avoid; }
.small-plots { display: grid; gap: 0.6rem 1.2rem;
  grid-template-columns: repeat(auto-fill, minmax(340px, 1fr)); }
.small-plots figure { margin: 0; }
.wide { overflow-x: auto; margin: 0.8rem 0; }
table { border-collapse: collapse; font-size: 0.85rem; line-height: 1.35;
  font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; padding: 0.3rem 0.5rem; }
th, td { padding: 0.3rem 0.55rem; text-align: right; vertical-align: top;
  border-bottom: 1px solid var(--rule); }
thead th { vertical-align: bottom; border-bottom: 2px solid var(--muted); font-weight: 600; }
thead th:first-child { text-align: left; }
tbody th, tfoot th, td.word { text-align: left; font-weight: 400;
  overflow-wrap: anywhere; min-width: 7rem; }
td.word { min-width: 0; }
td { white-space: nowrap; }
td small { display: block; color: var(--muted); font-size: 0.85em; }
.chosen { background: var(--panel); font-weight: 600; }
.chosen small { font-weight: 400; }
tfoot th, tfoot td { border-top: 2px solid var(--muted); color: var(--muted); }
tr.weft th { font-weight: 700; color: var(--accent); }
summary { cursor: pointer; color: var(--accent); }
.cards { display: flex; flex-wrap: wrap; gap: 0.6rem 1.6rem; }
.row { display: flex; flex-wrap: wrap; gap: 0.5rem; }
.row > div { max-width: 192px; }
.row span, figcaption { display: block; font-size: 0.82rem; }
.row span { color: var(--muted); overflow-wrap: anywhere; }
figcaption { font-weight: 600; margin: 0 0 0.25rem; max-width: 37rem; overflow-wrap: anywhere; }
.image { display: block; max-width: 100%; height: auto; }
.none { width: 192px; padding: 2rem 0; text-align: center; background: var(--panel); }
.scale { display: flex; align-items: center; gap: 0.6rem; font-size: 0.85rem; }
.scale .bar { width: 16rem; height: 0.9rem; print-color-adjust: exact; }
dl { max-width: 46rem; }
dt { font-weight: 600; }
dd { margin: 0 0 0.5rem 1.2rem; }
.facts td { text-align: left; white-space: normal; overflow-wrap: anywhere; }
@media print {
  body { max-width: none; padding: 0; font-size: 10pt; }
  h2, h3, caption { break-after: avoid; }
  tr, pre, li { break-inside: avoid; }
  thead { display: table-header-group; }
  table { font-size: 7pt; }
  .wide { overflow: visible; }
  th, td { padding: 0.15rem 0.25rem; }
}
)";
}

}  // namespace weft
