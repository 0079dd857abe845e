// SPDX-License-Identifier: Apache-2.0
#include "report/page_style.hpp"

#include "draw/paint.hpp"

namespace plumb::offline::report {
namespace {

/// Colours: --plumb-N is tone N of draw/paint.hpp. 0 paper, 1 ink, 2 muted, 3 grid, 4 band, 5 blue,
/// 6 vermilion, 7 green, 9 orange.
constexpr const char* kPage = R"css(
:root{color-scheme:light dark}
*{box-sizing:border-box}
html{background:var(--plumb-0);color:var(--plumb-1);font:16px/1.5 system-ui,'DejaVu Sans',sans-serif}
body{margin:0 auto;max-width:50rem;padding:1rem}
header h1{font-size:1.5rem;line-height:1.25;margin:.5rem 0 0}
h2{font-size:1.3rem;line-height:1.3;margin:2.5rem 0 .5rem;padding-top:.75rem;border-top:2px solid var(--plumb-3)}
h3{font-size:1.05rem;margin:1.5rem 0 .25rem}
p,ul,dl{margin:.5rem 0}
li{margin:.2rem 0}
a{color:var(--plumb-5)}
nav ol{columns:2;padding-left:1.6rem;font-size:.9rem}
.muted,caption,footer{color:var(--plumb-2);font-size:.9rem}
.verdict{border:2px solid;border-left-width:.6rem;border-radius:4px;padding:.6rem 1rem;margin:1rem 0}
.verdict strong{display:block;font-size:1.25rem}
.verdict p{margin:.25rem 0;color:var(--plumb-1)}
.good{color:var(--plumb-7)}.bad{color:var(--plumb-6)}.partly,.unknown{color:var(--plumb-9)}
.scroll{overflow-x:auto;margin:1rem 0}
table{border-collapse:collapse;font-size:.875rem;font-variant-numeric:tabular-nums;width:100%}
caption{text-align:left;padding:0 0 .3rem}
th,td{padding:.2rem .6rem;text-align:right;vertical-align:top;border-bottom:1px solid var(--plumb-3)}
.bar{color:var(--plumb-2);background:currentColor}
thead th{border-bottom:2px solid var(--plumb-2);vertical-align:bottom}
tbody th{font-weight:400;text-align:left}
.left{text-align:left}
dl{display:grid;grid-template-columns:minmax(7rem,max-content) 1fr;gap:.15rem 1rem}
dt{color:var(--plumb-2)}
dd{margin:0;overflow-wrap:anywhere}
p,li,th,td{overflow-wrap:break-word}
figure{margin:1rem 0}
figure svg{display:block;max-width:100%;height:auto}
.narrow{display:none}
pre{overflow-x:auto;background:var(--plumb-4);padding:.6rem .8rem;border-radius:4px;font-size:.8rem;line-height:1.4;margin:.5rem 0}
@media screen and (max-width:44rem){
.wide:has(+.narrow){display:none}.narrow{display:block}
nav ol{columns:1}
table{font-size:.8rem}th,td{padding:.2rem .35rem}td{white-space:nowrap}td.left{white-space:normal}
dl{grid-template-columns:1fr}dd{margin-bottom:.35rem}
}
@page{size:A4;margin:14mm 12mm}
@media print{
html{font-size:10pt;line-height:1.35}
th,td{padding:.12rem .6rem}
body{max-width:none;padding:0}
nav{display:none}
section{break-before:page}
section:first-of-type{break-before:auto}
h2{border:0;margin-top:0;padding-top:0}
h2,h3,caption{break-after:avoid}
figure,tr,.verdict,li,dt,dd{break-inside:avoid}
figure svg{max-height:245mm;max-width:100%;width:80%;margin:0 auto}
#verdict figure svg{width:74%}
figure,.verdict,.scroll{margin:.5rem 0}
p{orphans:3;widows:3}
#glossary dl{display:block;columns:2;column-gap:1.5rem;font-size:.85rem}
#glossary dt{color:inherit;font-weight:600;break-after:avoid}
#glossary dd{margin-bottom:.25rem}
tbody tr:first-child{break-before:avoid}
thead{display:table-header-group}
.scroll{overflow:visible}
pre{overflow:visible;white-space:pre-wrap;overflow-wrap:anywhere;font-size:.72rem;line-height:1.3;orphans:4;widows:4}
a{color:inherit;text-decoration:none}
}
)css";

}  // namespace

std::string page_style() { return draw::style_sheet() + kPage; }

}  // namespace plumb::offline::report
