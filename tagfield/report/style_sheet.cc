// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/style_sheet.h"

#include <fmt/format.h>

namespace tagfield {
namespace {

/// The palette whose colours are the page's custom properties.
Palette page_palette() {
  return {"var(--paper)",      "var(--panel)",    "var(--ink)",       "var(--muted)",
          "var(--grid)",       "var(--wall)",     "var(--wall-edge)", "var(--truth)",
          "var(--estimate)",   "var(--believed)", "var(--map-free)",  "var(--map-occupied)",
          "var(--map-unknown)"};
}

std::string properties(const Palette& palette) {
  return fmt::format(
      "--paper:{};--panel:{};--ink:{};--muted:{};--grid:{};--wall:{};--wall-edge:{};"
      "--truth:{};--estimate:{};--believed:{};--map-free:{};--map-occupied:{};--map-unknown:{}",
      palette.paper, palette.panel, palette.ink, palette.muted, palette.grid, palette.wall,
      palette.wall_edge, palette.truth, palette.estimate, palette.believed, palette.map_free,
      palette.map_occupied, palette.map_unknown);
}

constexpr const char* kSeries[kSeriesColors] = {"#2f7de1", "#e0662f", "#2f9e5b", "#c2419e",
                                                "#8a63d2", "#b3860a", "#159aae", "#dc4150",
                                                "#7c8894", "#6f9a22"};

std::string series_style() {
  std::string rules;
  for (std::size_t i = 0; i < kSeriesColors; ++i) {
    rules += fmt::format(
        "svg .line{0}{{fill:none;stroke:{1};stroke-width:2.2;stroke-linejoin:round}}\n"
        "svg .dot{0}{{fill:{1}}}\n",
        i, kSeries[i]);
  }
  return rules;
}

constexpr const char* kLayout = R"(*{box-sizing:border-box}
[hidden]{display:none!important}
html{-webkit-text-size-adjust:100%;text-size-adjust:100%}
body{margin:0;background:var(--paper);color:var(--ink);
font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,Helvetica,Arial,sans-serif;
overflow-wrap:anywhere}
main,header,footer{max-width:1216px;margin:0 auto;padding:0 14px}
header{padding-top:28px}
.kind{margin:0;color:var(--muted);font-size:.9rem}
h1{margin:0;font-size:clamp(1.3rem,6vw,1.9rem);line-height:1.2;font-weight:650;letter-spacing:-.01em}
h1,h2,summary,figcaption strong{overflow-wrap:break-word}
h2{margin:2.6rem 0 .8rem;font-size:1.25rem;font-weight:650}
p{margin:.5rem 0;max-width:46rem}
.muted,footer{color:var(--muted)}
.numbers{display:flex;flex-wrap:wrap;gap:1px;
margin:1.4rem 0;padding:0;background:var(--grid);border:1px solid var(--grid);border-radius:10px;
overflow:hidden}
.numbers div{flex:1 1 auto;min-width:132px;background:var(--paper);padding:.7rem .9rem}
.numbers dt{color:var(--muted);font-size:.85rem;line-height:1.3}
.numbers dd{margin:.1rem 0 0;font-size:1.5rem;line-height:1.25;font-weight:600;
font-variant-numeric:tabular-nums;white-space:nowrap}
.numbers .lead dd{color:var(--estimate)}
.facts{display:grid;grid-template-columns:max-content 1fr;gap:.15rem 1.1rem;margin:0}
.facts dt{color:var(--muted)}
.facts dd{margin:0}
.note{max-width:none;margin:1.2rem 0;padding:.75rem 1rem;background:var(--panel);
border-left:4px solid var(--muted);border-radius:0 8px 8px 0}
.note p{margin:.2rem 0;max-width:58rem}
.note ul{margin:.3rem 0;padding-left:1.2rem}
.incomplete{border-left-color:var(--truth)}
.pose{border-left-color:var(--believed)}
figure{margin:0 0 2.4rem;break-inside:avoid}
figure svg{display:block;width:100%;height:auto}
figcaption{margin-top:.5rem;font-size:.92rem;line-height:1.45;color:var(--muted)}
figcaption strong{color:var(--ink);font-weight:600}
.table{overflow-x:auto;border:1px solid var(--grid);border-radius:10px;
background:linear-gradient(to right,var(--paper) 40%,transparent) left/4rem 100% no-repeat local,
linear-gradient(to left,var(--paper) 40%,transparent) right/4rem 100% no-repeat local,
linear-gradient(to right,var(--wall-edge),transparent) left/.6rem 100% no-repeat scroll,
linear-gradient(to left,var(--wall-edge),transparent) right/.6rem 100% no-repeat scroll}
.hint{margin:.3rem 0 0;font-size:.85rem;color:var(--muted)}
.data{font-size:.85rem;white-space:nowrap;color:var(--estimate)}
table{border-collapse:collapse;width:100%;font-size:.92rem;font-variant-numeric:tabular-nums;
overflow-wrap:normal}
th,td{padding:.4rem .75rem;text-align:right;white-space:nowrap;
border-bottom:1px solid var(--grid)}
thead th{color:var(--muted);font-weight:500;vertical-align:bottom}
tbody tr:last-child>*{border-bottom:0}
tbody th,thead tr:first-child th:first-child{text-align:left;position:sticky;left:0;
background:var(--paper)}
tbody th{font-weight:600}
th[colspan]{text-align:center}
tbody th.group{text-align:left;background:var(--panel);max-width:none;overflow:visible}
th.group span{position:sticky;left:.75rem}
th.words,td.words{text-align:left}
td.words:last-child{white-space:normal;min-width:15rem}
.told td.words:last-child{min-width:9rem;width:99%}
footer{padding-top:1.5rem;padding-bottom:2.5rem;font-size:.9rem}
.filter{font:inherit;font-size:.92rem;width:100%;max-width:22rem;margin:.2rem 0 .6rem;padding:.35rem .6rem;
color:var(--ink);background:var(--paper);border:1px solid var(--grid);border-radius:8px}
details{margin:.5rem 0;border:1px solid var(--grid);border-radius:10px;padding:.45rem .8rem}
details[open]{padding-bottom:.8rem}
summary{cursor:pointer}
summary strong{font-weight:600}
details .table{margin-top:.6rem}
.heat td{font-weight:500;border:1px solid var(--paper)}
.heat td.best{font-weight:700;outline:2px solid var(--ink);outline-offset:-3px}
.heat td.none{color:var(--muted);font-weight:400}
.heat td.words{font-weight:600}
.tip{position:fixed;z-index:9;max-width:min(20rem,90vw);padding:.3rem .55rem;border-radius:6px;
background:var(--ink);color:var(--paper);font-size:.85rem;line-height:1.35;white-space:pre-line;
pointer-events:none}
.key[role]{cursor:pointer}
.zoom{float:right;display:flex;gap:3px;margin:0 0 .2rem .8rem;opacity:.5}
figure:hover .zoom,.zoom:focus-within{opacity:1}
.zoom button{font:inherit;font-size:.95rem;line-height:1;width:1.7rem;height:1.7rem;padding:0;cursor:pointer;
color:var(--ink);background:var(--paper);border:1px solid var(--wall-edge);border-radius:6px}
.zoom button:disabled{color:var(--muted);cursor:default}
svg.zoomed{cursor:grab;touch-action:none}
svg.zoomed line,svg.zoomed polyline,svg.zoomed path,svg.zoomed rect{vector-effect:non-scaling-stroke}
.linked{cursor:pointer;text-decoration:underline dotted;text-underline-offset:3px}
svg .chosen{stroke:var(--ink);stroke-width:3}
tr.chosen>*{background:var(--panel)!important;box-shadow:inset 0 2px var(--ink),inset 0 -2px var(--ink)}
.key[aria-pressed=false] text{text-decoration:line-through}
.key[aria-pressed=false]>:not(text){opacity:.3}
th[aria-sort=ascending]::after{content:" ↑"}
th[aria-sort=descending]::after{content:" ↓"}
.controls{display:flex;flex-wrap:wrap;gap:.6rem 1.6rem;align-items:center;margin:1rem 0}
.controls input[type=range]{width:min(26rem,70vw);vertical-align:middle}
.controls select{font:inherit;color:var(--ink);background:var(--paper)}
.swatches{display:flex;flex-wrap:wrap;gap:.2rem 1rem;font-size:.9rem;color:var(--muted);margin:.4rem 0 1rem}
.swatches i{display:inline-block;width:.9rem;height:.9rem;border-radius:50%;vertical-align:-.1rem;
margin-right:.35rem}
.left-out{display:none}
details.note{border-width:0 0 0 4px;border-radius:0 8px 8px 0}
details.note ul{margin-top:.5rem}
@media (min-width:900px){.figures{columns:2;column-gap:36px}}
@media (max-width:600px){.facts{grid-template-columns:fit-content(36%) 1fr}
tbody th{max-width:38vw;white-space:normal;overflow-wrap:break-word}}
@page{size:A4;margin:11mm}
@media print{html,body{font-size:9.6px}
main,header,footer{max-width:none;padding:0}
header{padding-top:0}
p,.note p{max-width:none}
h2{margin:.8rem 0 .4rem;break-after:avoid}
.numbers{margin:.6rem 0}
.numbers div{padding:.4rem .7rem;min-width:0}
.numbers dd{font-size:1.2rem}
.note{margin:.5rem 0;padding:.4rem .8rem}
.figures{columns:2;column-gap:7mm}
.figures.tall,.figures:has(figure:nth-of-type(5)){columns:3;column-gap:5mm}
.figures.dense{columns:4;column-gap:4mm}
figure{margin-bottom:.8rem}
figure svg{max-height:88mm}
.tall figure svg{max-height:140mm}
figcaption{margin-top:.2rem;line-height:1.3}
table{font-size:.9rem}
th,td{padding:.08rem .5rem}
tr{break-inside:avoid}
details{margin:0;padding:0;border-width:0}
details>:not(summary){display:none}
summary{display:block}
.note>summary::after,.more>summary::after{content:" – unfolded only on a screen";color:var(--muted);font-weight:400}
.table{overflow:visible;background:none}
.left-out{display:block;color:var(--muted)}
footer{padding:.4rem 0 0}
.screen,.filter,.hint,.data,.tip,.controls,.zoom,.unprinted{display:none}
.heat td,.numbers,.note{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
)";

}  // namespace

Palette light_palette() {
  return {"#ffffff", "#f4f6f8", "#1b1f24", "#57616b", "#e3e7eb", "#dde2e8", "#b4bdc7",
          "#c4129c", "#1659d6", "#bf6400", "#ffffff", "#1b1f24", "#c4c9cf"};
}

Palette dark_palette() {
  return {"#13161a", "#1c2127", "#e9ecef", "#a4aeb9", "#2b323a", "#2d353e", "#4d5865",
          "#ff66d8", "#74aaff", "#f2a54a", "#dfe3e7", "#0b0d0f", "#8f979f"};
}

std::string figure_style(const Palette& c) {
  std::string rules = fmt::format(
      "svg text{{font-family:Helvetica,Arial,'Liberation Sans','DejaVu Sans',sans-serif;"
      "font-size:15px;fill:{}}}\n"
      "svg .faint{{fill:{}}}\nsvg .rim{{fill:{};stroke:{};stroke-width:4;stroke-linejoin:round}}\n"
      "svg .grid{{stroke:{};stroke-width:1}}\nsvg .axis{{stroke:{};stroke-width:1}}\n"
      "svg .frame{{fill:none;stroke:{};stroke-width:1}}\n",
      c.ink, c.muted, c.paper, c.paper, c.grid, c.muted, c.wall_edge);
  rules += fmt::format(
      "svg .wall{{fill:{};fill-rule:evenodd;stroke:{};stroke-width:0.8}}\n"
      "svg .path{{fill:none;stroke:{};stroke-width:1.7;stroke-linejoin:round}}\n"
      "svg .thin{{fill:none;stroke:{};stroke-width:1;stroke-linejoin:round}}\n"
      "svg .ink{{fill:{}}}\n"
      "svg .start{{fill:{};stroke:{};stroke-width:1.7}}\n"
      "svg .rule{{stroke:{};stroke-width:1.2;stroke-dasharray:5 4}}\n",
      c.wall, c.wall_edge, c.ink, c.muted, c.ink, c.paper, c.ink, c.ink);
  rules += fmt::format(
      "svg .believed{{fill:none;stroke:{};stroke-width:1.5;stroke-dasharray:6 3}}\n"
      "svg .truth{{fill:{}}}\nsvg .true-line{{fill:none;stroke:{};stroke-width:2}}\n"
      "svg .estimate{{fill:none;stroke:{};stroke-width:2.4}}\n"
      "svg .halo{{fill:none;stroke:{};stroke-width:5}}\nsvg .measured{{fill:{}}}\n"
      "svg .pair{{stroke:{};stroke-width:1.4;stroke-dasharray:3 4}}\n",
      c.believed, c.truth, c.truth, c.estimate, c.paper, c.estimate, c.estimate);
  rules += fmt::format(
      "svg .bar{{fill:{};fill-opacity:0.85}}\nsvg .box{{fill:{};fill-opacity:0.25;stroke:{};"
      "stroke-width:1}}\nsvg .whisker{{stroke:{};stroke-width:1.2}}\n"
      "svg .spot{{fill:{};fill-opacity:0.5}}\nsvg .curve{{fill:none;stroke:{};stroke-width:2.2}}\n",
      c.estimate, c.estimate, c.estimate, c.estimate, c.estimate, c.estimate);
  rules += fmt::format(
      "svg .map-free{{fill:{};fill-rule:evenodd}}\n"
      "svg .map-occupied{{fill:{};fill-rule:evenodd}}\nsvg .map-unknown{{fill:{}}}\n"
      "svg .mapping{{fill:none;stroke:{};stroke-width:2.4;stroke-dasharray:8 4}}\n"
      "svg .mapping-true{{fill:none;stroke:{};stroke-width:1.2;stroke-linejoin:round}}\n"
      "svg .trace{{fill:none;stroke:{};stroke-width:1.3;stroke-linejoin:round}}\n"
      "svg .peak{{fill:{}}}\n",
      c.map_free, c.map_occupied, c.map_unknown, c.believed, c.truth, c.believed, c.believed);
  rules += fmt::format(
      "svg .outline{{fill:none;stroke:{};stroke-width:1;stroke-opacity:0.75}}\n"
      "svg .drive-rim{{fill:none;stroke:{};stroke-width:4;stroke-opacity:0.7}}\n"
      "svg .drive{{fill:none;stroke:{};stroke-width:1.7;stroke-linejoin:round}}\n"
      "svg .antenna{{fill:{};stroke:{};stroke-width:2}}\n"
      "svg .cover-own{{fill:#2f9e5b}}\nsvg .cover-also{{fill:#d08a00}}\n"
      "svg .cover-wrong{{fill:#c2419e}}\n"
      "svg .cover-never{{fill:none;stroke:#e0452f;stroke-width:2.6}}\n",
      c.ink, c.paper, c.ink, c.ink, c.paper);
  rules += fmt::format(
      "svg .band{{fill:{};fill-opacity:0.28}}\n"
      "svg .ring{{fill:none;stroke:{};stroke-width:2;pointer-events:none}}\n"
      "svg .key{{pointer-events:bounding-box}}\n",
      c.muted, c.ink);
  return rules + series_style();
}

std::string page_style() {
  return ":root{color-scheme:light dark;" + properties(light_palette()) + "}\n" +
         "@media screen and (prefers-color-scheme:dark){:root{" + properties(dark_palette()) +
         "}}\n" + kLayout + ".on-map{" + properties(light_palette()) + "}\n" +
         figure_style(page_palette());
}

}  // namespace tagfield
