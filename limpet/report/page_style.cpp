// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/page_style.hpp"

namespace limpet::report {

const char* page_style() {
    return R"css(
:root {
  color-scheme: light;
  --ground: #f3f4f2; --sheet: #ffffff; --ink: #222b33; --soft: #56616b; --line: #dde2e7;
  --band: #f6f8f9; --link: #0b5a94; --good: #17653f; --good-ground: #e4f3ea;
  --bad: #94400a; --bad-ground: #fdeedd; --none: #4d5862; --none-ground: #eceff2;
}
@media screen and (prefers-color-scheme: dark) {
  :root {
    color-scheme: dark;
    --ground: #14181c; --sheet: #1c2126; --ink: #e4e8ec; --soft: #a4aeb8; --line: #38414a;
    --band: #232a30; --link: #8cc4f0; --good: #8fdcb1; --good-ground: #1c3a2b;
    --bad: #f6b983; --bad-ground: #432c17; --none: #b9c2cb; --none-ground: #2f373f;
  }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; text-size-adjust: 100%; }
body {
  margin: 0; background: var(--ground); color: var(--ink);
  font: 1.0625rem/1.6 Charter, "Bitstream Charter", "Sitka Text", Cambria, Georgia, serif;
  overflow-wrap: anywhere;
}
main {
  max-width: 72rem; margin: 0 auto; padding: 3.5rem 4rem 4rem; background: var(--sheet);
}
h1, h2, h3, nav, table, figcaption, .subtitle, .verdicts, .badge, footer {
  font-family: "DejaVu Sans", Verdana, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif;
}
h1 { margin: 0 0 .4rem; font-size: 1.9rem; line-height: 1.25; font-weight: 600; text-wrap: balance; }
h2 {
  margin: 3.2rem 0 1rem; padding-top: .8rem; border-top: 2px solid var(--ink);
  font-size: 1.3rem; line-height: 1.3; font-weight: 600;
}
h3 { margin: 2.2rem 0 .6rem; font-size: 1rem; line-height: 1.4; font-weight: 600; }
h2 .number { color: var(--soft); margin-right: .6em; font-weight: 400; }
p { margin: 0 0 1rem; max-width: 44rem; }
a { color: var(--link); text-underline-offset: .15em; }
a:focus-visible, .scroll:focus-visible { outline: 3px solid var(--link); outline-offset: 2px; }
code { font: .88em/1.4 "DejaVu Sans Mono", Menlo, Consolas, monospace; }
.subtitle { color: var(--soft); font-size: .95rem; }
.verdicts { display: flex; flex-wrap: wrap; gap: .6rem; margin: 1.6rem 0; padding: 0; list-style: none; }
.verdicts .badge { font-size: .95rem; padding: .35rem .8rem; }
nav { margin: 2rem 0 0; font-size: .92rem; }
nav ol { margin: .4rem 0 0; padding: 0; list-style: none; columns: 2 18rem; column-gap: 2.5rem; }
nav li { display: flex; padding: .2rem 0; break-inside: avoid; }
nav .number { flex: none; width: 1.7rem; color: var(--soft); }
.badge {
  display: inline-block; padding: .1rem .5rem; border-radius: .3rem; white-space: nowrap;
  font-size: .82rem; line-height: 1.5; font-weight: 600;
}
.badge.reproduced { color: var(--good); background: var(--good-ground); }
.badge.differs { color: var(--bad); background: var(--bad-ground); }
.badge.not-modelled { color: var(--none); background: var(--none-ground); }
.scroll { overflow-x: auto; margin: 0 0 .6rem; }
table { border-collapse: collapse; font-size: .84rem; line-height: 1.45; }
th, td { padding: .45rem .6rem; border-bottom: 1px solid var(--line); text-align: left; vertical-align: top; }
.scroll th, .scroll td { overflow-wrap: normal; }
thead th { border-bottom: 1.5px solid var(--ink); font-weight: 600; vertical-align: bottom; }
tbody th { font-weight: 400; }
.scroll tbody tr:nth-child(even) { background: var(--band); }
.number-cell { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.caption { color: var(--soft); font-size: .9rem; }
.claims { width: 100%; table-layout: fixed; }
.claims col.id { width: 9%; } .claims col.where { width: 8.5%; } .claims col.value { width: 12%; }
.claims col.difference { width: 10.5%; } .claims col.verdict { width: 13.5%; } .claims col.see { width: 8.5%; }
.claims th, .claims td { padding: .55rem .45rem; }
.claims .badge { font-size: .76rem; }
.claims .id { color: var(--soft); font-size: .74rem; }
.claims .note { display: block; margin-top: .3rem; color: var(--soft); font-size: .78rem; }
.claims .basis { display: block; margin-top: .25rem; color: var(--soft); font-size: .74rem; }
.claims td a { display: block; }
.claims tr:target > * { background: var(--band); }
.unit { color: var(--soft); }
figure { margin: 1.8rem 0 2.4rem; }
figure img {
  display: block; max-width: 100%; height: auto; background: #ffffff; border-radius: .2rem;
}
.frame { overflow-x: auto; }
figcaption { margin-top: .6rem; max-width: 48rem; font-size: .86rem; line-height: 1.5; color: var(--soft); }
figcaption strong:first-child { color: var(--ink); }
figcaption .files { white-space: nowrap; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .3rem 1.4rem; margin: 0; font-size: .9rem; }
dt { color: var(--soft); } dd { margin: 0; }
@media (max-width: 60rem) { main { padding: 2rem 2rem 3rem; } }
@media screen and (max-width: 52rem) {
  .claims, .claims tbody, .claims th, .claims td { display: block; width: auto; }
  .claims colgroup, .claims thead { display: none; }
  .claims tr {
    display: grid; grid-template-columns: repeat(6, 1fr); column-gap: .8rem;
    padding: 1rem 0; border-bottom: 1px solid var(--line);
  }
  .claims th, .claims td { grid-column: span 2; padding: .12rem 0; border: 0; }
  .claims td.id { grid-column: span 1; white-space: nowrap; }
  .claims td.where { color: var(--soft); font-size: .78rem; }
  .claims td.verdict { grid-column: span 3; grid-row: 1; grid-column-end: 7; text-align: right; }
  .claims tbody th, .claims td.see { grid-column: 1 / -1; }
  .claims tbody th { margin: .2rem 0 .5rem; font-size: .95rem; }
  .claims td[data-label]::before {
    content: attr(data-label); display: block; color: var(--soft); font-size: .74rem;
  }
  .claims td a { display: inline-block; margin-right: 1.2rem; padding: .3rem 0; }
  .claims .empty { display: none; }
}
@media screen and (max-width: 40rem) {
  body { font-size: 1rem; }
  main { padding: 1.4rem 1.1rem 2.5rem; }
  h1 { font-size: 1.45rem; } h2 { font-size: 1.15rem; margin-top: 2.4rem; }
  nav li { padding: .4rem 0; }
  .wide img { max-width: 62rem; }
  dl { display: block; } dd { margin: 0 0 .5rem; }
}
@media print {
  @page { margin: 16mm 14mm; }
  html { font-size: 9.5pt; }
  body, main { background: #ffffff; }
  main { max-width: none; padding: 0; }
  a { color: inherit; text-decoration: none; }
  h2, h3 { break-after: avoid; }
  h2 { margin-top: 1.8rem; }
  tr, figure, .badge { break-inside: avoid; }
  thead { display: table-header-group; }
  figure img { max-height: 92mm; width: auto; }
  .tall img { max-height: 205mm; }
  .wide img { max-height: 165mm; }
  .scroll, .frame { overflow: visible; }
  .badge { border: 1px solid currentColor; }
  .files { display: none; }
}
)css";
}

}  // namespace limpet::report
