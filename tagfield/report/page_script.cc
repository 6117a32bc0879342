// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/page_script.h"

namespace tagfield {
namespace {

constexpr PageScript kTables = {R"js((()=>{
const number=text=>{const n=parseFloat(text.replace(/[,\s]/g,"").replace("−","-"));return isNaN(n)?null:n};
for(const box of document.querySelectorAll(".table")){
 const hint=document.createElement("p");
 hint.className="hint";hint.textContent="The table goes on to the right: scroll it sideways →";box.after(hint);
 const look=()=>{hint.hidden=box.scrollWidth<=box.clientWidth+1};
 new ResizeObserver(look).observe(box);look();
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
                                "sha256-O1QJJf+qCmaSxnD6NjjHkfT62NojrdA704eylgsZj1E="};

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
 const ring=document.createElementNS(svg.namespaceURI,"circle");
 ring.setAttribute("class","ring");ring.setAttribute("r","6");ring.style.display="none";svg.append(ring);
 const collect=()=>{
  marks=[];
  for(const e of svg.querySelectorAll("circle,polyline,path,rect,line")){
   if(e===ring||e.closest(".key,[transform],clipPath"))continue;
   const title=e.querySelector("title"),text=title?title.textContent:"";
   if(title)title.remove();
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
 const look=event=>{
  if(!marks)collect();
  const p=new DOMPoint(event.clientX,event.clientY).matrixTransform(svg.getScreenCTM().inverse());
  let found=null,least=reach;
  for(const mark of marks){
   if(mark.e.style.display==="none")continue;
   const q=nearest(mark,p),d=Math.hypot(q[0]-p.x,q[1]-p.y)+(mark.text?0:2);
   if(d<least){least=d;found={mark,q}}
  }
  if(!found)return hide();
  const [x,y]=found.q,panel=panels.find(a=>within(a.x,x)&&within(a.y,y)),lines=[];
  const has=found.mark.e.classList,name=names[Object.keys(names).find(k=>k.split(" ").every(c=>has.contains(c)))];
  if(found.mark.text)lines.push(found.mark.text);
  else if(name)lines.push(name);
  if(panel&&!found.mark.text){
   const xn=panel.xn||(panels.find(a=>a.xn)||{}).xn||"x";
   lines.push(xn+": "+spoken(value(panel.x,x)));
   if(panel.yn)lines.push(panel.yn+": "+spoken(value(panel.y,y)));
  }
  if(!lines.length)return hide();
  tip.textContent=lines.join("\n");tip.hidden=false;
  const w=tip.offsetWidth,h=tip.offsetHeight;
  tip.style.left=Math.max(4,Math.min(event.clientX+14,innerWidth-w-4))+"px";
  tip.style.top=(event.clientY-h-12<4?event.clientY+18:event.clientY-h-12)+"px";
  ring.setAttribute("cx",x);ring.setAttribute("cy",y);ring.style.display=found.mark.box?"none":"";
 };
 svg.addEventListener("pointermove",look);svg.addEventListener("pointerdown",look);svg.addEventListener("pointerleave",hide);
}
addEventListener("scroll",()=>{tip.hidden=true},{passive:true});
})();)js",
                                 "sha256-Ti2hSCWupsPC7ZazxaIGwlKQI7kauT79fE08rb6Okik="};

constexpr PageScript kLinks = {R"js((()=>{
const make=(tag,attributes)=>{
 const made=document.createElement(tag);
 for(const name in attributes)made.setAttribute(name,attributes[name]);
 return made;
};
const most=16,small=26,near=60;
const middle=box=>[box.x+box.width/2,box.y+box.height/2];
const zooms=new Map(),named=new Set();
for(const title of document.querySelectorAll("figure svg title"))named.add(title.parentNode);
for(const svg of document.querySelectorAll("figure svg")){
 if(!svg.querySelector("g.axes"))continue;
 const home=svg.getAttribute("viewBox").split(" ").map(Number);
 let view=[...home],marks=null,held=null,moved=false;
 const scale=()=>home[2]/view[2];
 const prepare=()=>{
  marks=[];
  const centers=[];
  for(const e of svg.querySelectorAll("circle,path,line,rect")){
   if(e.closest(".key,.axes,[transform],clipPath")||e.tagName!=="circle"&&!named.has(e)&&!e.classList.contains("halo"))continue;
   const box=e.getBBox();
   if(box.width>small||box.height>small||box.width+box.height===0)continue;
   const at=middle(box);
   centers.push(at);marks.push([e,at]);
  }
  for(const e of svg.querySelectorAll("text")){
   if(e.closest(".key,.axes"))continue;
   const at=middle(e.getBBox());
   let best=null,least=near;
   for(const c of centers){const d=Math.hypot(c[0]-at[0],c[1]-at[1]);if(d<least){least=d;best=c}}
   marks.push([e,best||at]);
  }
 };
 const draw=()=>{
  if(!marks)prepare();
  const k=scale();
  svg.setAttribute("viewBox",view.join(" "));
  svg.classList.toggle("zoomed",k>1);
  for(const [e,at] of marks)e.style.transform=k>1?`translate(${at[0]}px,${at[1]}px) scale(${1/k}) translate(${-at[0]}px,${-at[1]}px)`:"";
  back.disabled=out.disabled=k<=1;closer.disabled=k>=most;
 };
 const zoom=(factor,at)=>{
  const k=Math.min(Math.max(scale()*factor,1),most),w=home[2]/k,h=home[3]/k;
  const x=at[0]-(at[0]-view[0])*w/view[2],y=at[1]-(at[1]-view[1])*h/view[3];
  place(x,y,w,h);
 };
 const place=(x,y,w,h)=>{
  view=[Math.min(Math.max(x,home[0]),home[0]+home[2]-w),Math.min(Math.max(y,home[1]),home[1]+home[3]-h),w,h];
  draw();
 };
 const at=event=>{const p=new DOMPoint(event.clientX,event.clientY).matrixTransform(svg.getScreenCTM().inverse());return [p.x,p.y]};
 const center=()=>[view[0]+view[2]/2,view[1]+view[3]/2];
 const bar=make("div",{class:"zoom"});
 const button=(text,label,act)=>{const b=make("button",{type:"button","aria-label":label,title:label});b.textContent=text;b.addEventListener("click",act);bar.append(b);return b};
 const closer=button("+","Zoom in",()=>zoom(2,center()));
 const out=button("−","Zoom out",()=>zoom(.5,center()));
 const back=button("⟲","Show all",()=>{view=[...home];draw()});
 back.disabled=out.disabled=true;
 (svg.closest("figure").querySelector("figcaption")||svg.closest("figure")).prepend(bar);
 svg.addEventListener("dblclick",event=>{event.preventDefault();zoom(2,at(event))});
 svg.addEventListener("wheel",event=>{if(!event.ctrlKey)return;event.preventDefault();zoom(event.deltaY<0?1.25:.8,at(event))},{passive:false});
 svg.addEventListener("pointerdown",event=>{moved=false;if(scale()>1){held=at(event);svg.setPointerCapture(event.pointerId)}});
 svg.addEventListener("pointermove",event=>{
  if(!held)return;
  const p=at(event);
  if(!moved&&Math.hypot(p[0]-held[0],p[1]-held[1])*scale()<4)return;
  moved=true;place(view[0]+held[0]-p[0],view[1]+held[1]-p[1],view[2],view[3]);
 });
 const drop=()=>{held=null};
 svg.addEventListener("pointerup",drop);svg.addEventListener("pointercancel",drop);
 const reveal=e=>{
  const [x,y]=middle(e.getBBox());
  if(x<view[0]||x>view[0]+view[2]||y<view[1]||y>view[1]+view[3]){view=[...home];draw()}
 };
 zooms.set(svg,{dragged:()=>moved,reveal});
}
const rows=new Map();
for(const th of document.querySelectorAll("[aria-label=Tags] tbody th[scope=row]"))rows.set(th.title||th.textContent.trim(),th.parentNode);
if(!rows.size)return;
const of=new Map(),tagOf=new Map();
for(const title of document.querySelectorAll("figure svg title")){
 const text=title.textContent,e=title.parentNode;
 if(e.closest(".key"))continue;
 let tag=text;
 while(tag&&!rows.has(tag))tag=tag.slice(0,Math.max(tag.lastIndexOf(","),tag.lastIndexOf(":"),tag.lastIndexOf(" "),0));
 if(!tag)continue;
 tagOf.set(e,tag);
 if(!of.has(tag))of.set(tag,[]);
 of.get(tag).push(e);
}
let chosen="";
const choose=tag=>{
 for(const e of document.querySelectorAll(".chosen"))e.classList.remove("chosen");
 chosen=tag===chosen?"":tag;
 if(!chosen)return;
 for(const e of of.get(chosen)||[]){e.classList.add("chosen");e.parentNode.append(e)}
 rows.get(chosen).classList.add("chosen");
};
for(const [tag,row] of rows){
 if(!of.has(tag))continue;
 const cell=row.cells[0];
 cell.classList.add("linked");cell.tabIndex=0;
 const go=()=>{choose(tag);const first=chosen&&of.get(tag)[0];if(!first)return;
  for(const e of of.get(tag)){const zoom=zooms.get(e.ownerSVGElement);if(zoom)zoom.reveal(e)}
  first.ownerSVGElement.scrollIntoView({block:"center",behavior:"smooth"});
 };
 cell.addEventListener("click",go);
 cell.addEventListener("keydown",event=>{if(event.key==="Enter")go()});
}
for(const svg of document.querySelectorAll("figure svg"))svg.addEventListener("click",event=>{
 const zoom=zooms.get(svg);
 if(zoom&&zoom.dragged())return;
 const p=new DOMPoint(event.clientX,event.clientY).matrixTransform(svg.getScreenCTM().inverse());
 let best=null,least=24;
 for(const e of svg.querySelectorAll("circle,path,rect,line")){
  if(!tagOf.has(e)||e.style.display==="none")continue;
  const b=e.getBBox(),x=Math.min(Math.max(p.x,b.x),b.x+b.width),y=Math.min(Math.max(p.y,b.y),b.y+b.height),d=Math.hypot(x-p.x,y-p.y);
  if(d<least){least=d;best=e}
 }
 if(!best)return;
 choose(tagOf.get(best));
 if(!chosen)return;
 const row=rows.get(chosen);
 row.hidden=false;row.scrollIntoView({block:"center",behavior:"smooth"});
});
addEventListener("keydown",event=>{if(event.key==="Escape"&&chosen)choose(chosen)});
})();)js",
                               "sha256-b1sKKzGgK89f5vdXf+tePCMrV3smXtorrK96jupqeW8="};

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

const PageScript& figure_script() { return kFigures; }

const PageScript& link_script() { return kLinks; }

const PageScript& plan_script() { return kPlan; }

std::string script_html(const PageScript& script) {
  return std::string("<script>") + script.text + "</script>\n";
}

}  // namespace tagfield
