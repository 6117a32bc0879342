// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/page_script.h"

namespace tagfield {
namespace {

constexpr PageScript kTables = {R"js((()=>{
const number=text=>{const n=parseFloat(text.replace(/[,\s]/g,"").replace("−","-"));return isNaN(n)?null:n};
for(const box of document.querySelectorAll(".table")){
 const table=box.querySelector("table"),body=table&&table.tBodies[0];
 if(!body||body.rows.length<2||body.querySelector("[colspan],[rowspan]")||!table.tHead||table.tHead.rows.length>1)continue;
 const rows=[...body.rows];
 [...table.tHead.rows[0].cells].forEach((head,column)=>{
  let rising=false;
  head.tabIndex=0;head.style.cursor="pointer";head.title="Sort by this column";
  const sort=()=>{
   rising=!rising;
   const key=row=>row.cells[column]?row.cells[column].textContent.trim():"";
   const all=[...body.rows].map(row=>({row,text:key(row),n:number(key(row))}));
   all.sort((a,b)=>(a.n!==null&&b.n!==null?a.n-b.n:a.text.localeCompare(b.text,"en",{numeric:true}))*(rising?1:-1));
   for(const one of all)body.append(one.row);
   for(const other of table.tHead.rows[0].cells)other.removeAttribute("aria-sort");
   head.setAttribute("aria-sort",rising?"ascending":"descending");
  };
  head.addEventListener("click",sort);
  head.addEventListener("keydown",event=>{if(event.key==="Enter")sort()});
 });
 if(rows.length<9)continue;
 const filter=document.createElement("input");
 filter.type="search";filter.placeholder="Filter "+rows.length+" rows";filter.className="filter";
 filter.setAttribute("aria-label","Filter the rows");
 filter.addEventListener("input",()=>{
  const word=filter.value.toLowerCase();
  for(const row of rows)row.hidden=!row.textContent.toLowerCase().includes(word);
 });
 box.before(filter);
}
})();)js",
                                "sha256-n6JsRp95gn0wOuwH5KanHkagI4Iwtlali81EpcSFzAg="};

constexpr PageScript kPlan = {R"js((()=>{
const data=JSON.parse(document.getElementById("plan-data").textContent);
const slider=document.getElementById("plan-count"),other=document.getElementById("plan-other");
const band=(edges,value)=>{let i=0;while(i<edges.length&&value>=edges[i])++i;return i};
const show=()=>{
 const at=+slider.value,than=other.value===""?-1:+other.value;
 const layout=data.layouts[at];
 for(const circle of document.querySelectorAll("circle.place")){
  const i=+circle.dataset.place,p=layout.places[i]/100;
  if(than<0){circle.setAttribute("fill",data.colors[band(data.edges,p)]||"#8a949e")}
  else{circle.setAttribute("fill",data.gain_colors[band(data.gain_edges,data.layouts[than].places[i]/100-p)])}
  circle.firstChild.textContent=data.names[i]+": "+layout.places[i]+" %"+(than<0?"":", with "+data.layouts[than].antennas+" antennas "+data.layouts[than].places[i]+" %");
 }
 for(const group of document.querySelectorAll("g.layout")){
  const n=+group.dataset.layout;
  group.style.display=n===at||n===than?"":"none";
  group.style.opacity=n===at?1:.45;
 }
 for(const field of document.querySelectorAll("[data-field]")){
  const name=field.dataset.field;
  field.textContent=layout[name]+(than<0||field.dataset.alone!==undefined?"":" → "+data.layouts[than][name]);
 }
 document.getElementById("plan-legend").hidden=than>=0;
 document.getElementById("plan-gain-legend").hidden=than<0;
 for(const row of document.querySelectorAll("#plan-antennas tbody tr"))row.hidden=+row.dataset.layout!==at;
};
slider.addEventListener("input",show);other.addEventListener("change",show);
document.getElementById("plan-controls").hidden=false;
show();
})();)js",
                              "sha256-VvbjsjYiHpDCnuVeWCGlxUVPzReTIZLqX15cVAkDo9s="};

}  // namespace

const PageScript& table_script() { return kTables; }

const PageScript& plan_script() { return kPlan; }

std::string script_html(const PageScript& script) {
  return std::string("<script>") + script.text + "</script>\n";
}

}  // namespace tagfield
