// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/page_script.h"

namespace tagfield {
namespace {

constexpr PageScript kTables = {R"js((()=>{
const printed=40,number=text=>{const n=parseFloat(text.replace(/[,\s]/g,"").replace("−","-"));return isNaN(n)?null:n};
for(const box of document.querySelectorAll(".table")){
 const hint=document.createElement("p");
 hint.className="hint";hint.textContent="The table continues to the right: scroll it sideways →";box.after(hint);
 const look=()=>{hint.hidden=box.scrollWidth<=box.clientWidth+1};
 new ResizeObserver(look).observe(box);look();
 const table=box.querySelector("table"),body=table&&table.tBodies[0];
 if(!body)continue;
 const left=document.createElement("p");
 left.className="left-out";hint.after(left);
 const cut=()=>{
  const shown=[...body.rows].filter(row=>!row.hidden);
  for(const row of body.rows)row.classList.remove("unprinted");
  for(const row of shown.slice(printed))row.classList.add("unprinted");
  left.hidden=shown.length<=printed;
  left.textContent=`The first ${printed} of ${shown.length} rows; the page on a screen has all.`;
 };
 addEventListener("beforeprint",cut);cut();
 if(body.rows.length<2||body.querySelector("[colspan],[rowspan]")||!table.tHead||table.tHead.rows.length>1)continue;
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
 if(rows.length<9||rows[0].dataset.layout)continue;
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
                                "sha256-C9oTCkp7YuAvIm4d9ZmDRbTGFkCAS7cz1zcjNetl/lQ="};

constexpr PageScript kFigures = {R"js((()=>{
const put=(tag,name)=>{const made=document.createElement(tag);made.className=name;return made};
const tip=put("div","tip");tip.hidden=true;tip.setAttribute("aria-hidden","true");document.body.append(tip);
const spoken=v=>(v!==0&&(Math.abs(v)<1e-3||Math.abs(v)>=1e6)?v.toExponential(2):String(+v.toPrecision(4))).replace("-","−");
const value=(span,at)=>{
 const [low,high,from,to]=span.map(Number),t=(at-from)/(to-from);
 return span[4]==="log"?low*(high/low)**t:low+t*(high-low);
};
const within=(span,at)=>{const ends=[+span[2],+span[3]];return at>=Math.min(...ends)-1&&at<=Math.max(...ends)+1};
const reach=24;
for(const svg of document.querySelectorAll("figure svg")){
 const names={},panels=[...svg.querySelectorAll("g.axes")].map(g=>({x:g.dataset.x.split(" "),y:g.dataset.y.split(" "),xn:g.dataset.xName,yn:g.dataset.yName}));
 for(const key of svg.querySelectorAll("g.key")){
  const kind=key.dataset.key,drawn=[...svg.getElementsByClassName(kind)].filter(e=>!e.closest(".key"));
  names[kind]=key.textContent.trim();
  if(!drawn.length)continue;
  svg.setAttribute("role","group");
  key.tabIndex=0;key.setAttribute("role","button");key.setAttribute("aria-pressed","true");
  key.setAttribute("aria-label","Show "+names[kind]);
  const turn=()=>{
   const shown=key.getAttribute("aria-pressed")!=="true";
   key.setAttribute("aria-pressed",shown);
   for(const e of drawn)e.style.display=shown?"":"none";
  };
  key.addEventListener("click",turn);
  key.addEventListener("keydown",event=>{if(event.key==="Enter"||event.key===" "){event.preventDefault();turn()}});
 }
 let marks=null;
 const texts=new WeakMap();
 svg.addEventListener("redrawn",()=>{marks=null});
 const ring=document.createElementNS(svg.namespaceURI,"circle");
 ring.setAttribute("class","ring");ring.setAttribute("r","6");ring.style.display="none";svg.append(ring);
 const collect=()=>{
  marks=[];
  for(const e of svg.querySelectorAll("circle,polyline,path,rect,line")){
   if(e===ring||e.closest(".key,[transform],clipPath"))continue;
   const title=e.querySelector("title");
   if(title){texts.set(e,title.textContent);title.remove()}
   const text=texts.get(e)||"";
   if(e.tagName==="polyline"){
    const line=e.getAttribute("points").trim().split(/[\s,]+/).map(Number),at=[];
    for(let i=0;i+1<line.length;i+=2)at.push([line[i],line[i+1]]);
    marks.push({e,text,line:at});
   }else if(e.tagName==="circle")marks.push({e,text,line:[[+e.getAttribute("cx"),+e.getAttribute("cy")]]});
   else if(text){const b=e.getBBox();marks.push(e.tagName==="line"?{e,text,line:["1","2"].map(n=>[+e.getAttribute("x"+n),+e.getAttribute("y"+n)])}:{e,text,box:b})}
  }
 };
 const nearest=(mark,p)=>{
  if(mark.box){
   const b=mark.box,x=Math.min(Math.max(p.x,b.x),b.x+b.width),y=Math.min(Math.max(p.y,b.y),b.y+b.height);
   return [x,y];
  }
  let best=mark.line[0],least=Infinity;
  mark.line.forEach((a,i)=>{
   const b=mark.line[i+1]||a,dx=b[0]-a[0],dy=b[1]-a[1],n=dx*dx+dy*dy;
   const t=n?Math.min(Math.max(((p.x-a[0])*dx+(p.y-a[1])*dy)/n,0),1):0,q=[a[0]+t*dx,a[1]+t*dy];
   const d=Math.hypot(q[0]-p.x,q[1]-p.y);
   if(d<least){least=d;best=q}
  });
  return best;
 };
 const hide=()=>{tip.hidden=true;ring.style.display="none"};
 const tell=(event,lines)=>{
  tip.textContent=lines.join("\n");tip.hidden=false;
  const w=tip.offsetWidth,h=tip.offsetHeight;
  tip.style.left=Math.max(4,Math.min(event.clientX+14,innerWidth-w-4))+"px";
  tip.style.top=(event.clientY-h-12<4?event.clientY+18:event.clientY-h-12)+"px";
 };
 const look=event=>{
  if(!marks)collect();
  const p=new DOMPoint(event.clientX,event.clientY).matrixTransform(svg.getScreenCTM().inverse());
  let found=null,least=reach;
  for(const mark of marks){
   if(mark.e.style.display==="none"||mark.e.parentNode.style.display==="none")continue;
   const q=nearest(mark,p),d=Math.hypot(q[0]-p.x,q[1]-p.y)+(mark.text?0:2);
   if(d<least){least=d;found={mark,q}}
  }
  const cell=found?null:event.target.closest("[data-cell]");
  if(!found&&!cell)return hide();
  const [x,y]=found?found.q:[p.x,p.y],panel=panels.find(a=>within(a.x,x)&&within(a.y,y)),lines=[];
  if(cell){
   lines.push(cell.dataset.cell);
   if(panel)lines.push((panel.xn||"x")+": "+spoken(value(panel.x,x)),(panel.yn||"y")+": "+spoken(value(panel.y,y)));
   ring.style.display="none";
   return tell(event,lines);
  }
  const has=found.mark.e.classList,name=names[Object.keys(names).find(k=>k.split(" ").every(c=>has.contains(c)))];
  if(found.mark.text)lines.push(found.mark.text);
  else if(name)lines.push(name);
  if(panel&&!found.mark.text){
   const xn=panel.xn||(panels.find(a=>a.xn)||{}).xn||"x";
   lines.push(xn+": "+spoken(value(panel.x,x)));
   if(panel.yn)lines.push(panel.yn+": "+spoken(value(panel.y,y)));
  }
  if(!lines.length)return hide();
  tell(event,lines);
  ring.setAttribute("cx",x);ring.setAttribute("cy",y);ring.style.display=found.mark.box?"none":"";
 };
 svg.addEventListener("pointermove",look);svg.addEventListener("pointerdown",look);svg.addEventListener("pointerleave",hide);
}
addEventListener("scroll",()=>{tip.hidden=true},{passive:true});
})();)js",
                                 "sha256-GPSY23NC87ncCqPLQHRuP5hp1U97aAEkVvOxjEVdaKE="};

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
  let title=circle.querySelector("title");
  if(!title){title=document.createElementNS(circle.namespaceURI,"title");circle.append(title)}
  title.textContent=data.names[i]+": "+layout.places[i]+" %"+(than<0?"":", with "+data.layouts[than].antennas+" antennas "+data.layouts[than].places[i]+" %");
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
 for(const svg of document.querySelectorAll("figure svg"))svg.dispatchEvent(new Event("redrawn"));
};
slider.addEventListener("input",show);other.addEventListener("change",show);
document.getElementById("plan-controls").hidden=false;
show();
})();)js",
                              "sha256-QcHd9ohdtO80WUH20JBF2O8zI1x7G3ylFEIZ33cVPNs="};

}  // namespace

const PageScript& table_script() { return kTables; }

const PageScript& figure_script() { return kFigures; }

const PageScript& plan_script() { return kPlan; }

std::string script_html(const PageScript& script) {
  return std::string("<script>") + script.text + "</script>\n";
}

}  // namespace tagfield
