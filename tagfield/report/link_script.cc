// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/page_script.h"

namespace tagfield {
namespace {

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
   const at=e.dataset.at?e.dataset.at.split(" ").map(Number):middle(box);
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
                               "sha256-0IkWXdyXsmXkT+Nu0zDsj8tUwa4+lAJQMO6BRr8kvmY="};

}  // namespace

const PageScript& link_script() { return kLinks; }

}  // namespace tagfield
