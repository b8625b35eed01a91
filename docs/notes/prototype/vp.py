import numpy as np, sys, pathlib, pickle, time
veh=[10,13,18,20,21,252,257,258,259]; ign=[0,1,52,81,99]
grd=[40,44,48,49,60,72]
def comps(xy,cell=0.5):
    c=np.floor(xy/cell).astype(np.int64); key=c[:,0]*1000003+c[:,1]
    u,inv=np.unique(key,return_inverse=True)
    uc=np.zeros((len(u),2),np.int64); uc[inv]=c
    ind={k:i for i,k in enumerate(u.tolist())}
    lab=-np.ones(len(u),int); n=0
    for i in range(len(u)):
        if lab[i]>=0: continue
        lab[i]=n; st=[i]
        while st:
            a=st.pop()
            for dx in(-1,0,1):
                for dy in(-1,0,1):
                    j=ind.get(int((uc[a,0]+dx)*1000003+uc[a,1]+dy))
                    if j is not None and lab[j]<0: lab[j]=n; st.append(j)
        n+=1
    return lab[inv],n
def load(rec,seg,t):
    p=np.fromfile(rec/'velodyne'/(t+'.bin'),'<f4').reshape(-1,4)[:,:3]
    w=np.fromfile(rec/'labels'/(t+'.label'),'<u4')&0xFFFF
    g=np.fromfile(seg/'labels'/(t+'.label'),'<u4')&0xFFFF
    f=seg/'probability'; f=[x for x in f.glob(t+'.*')][0]
    raw=f.read_bytes()
    n=len(p)
    pr=np.frombuffer(raw,'<f4') if len(raw)==4*n else np.frombuffer(raw,'u1')/255.0
    return p,w,g,pr
def features(rec,seg,t):
    p,w,g,pr=load(rec,seg,t)
    G=np.isin(g,veh)&np.isfinite(p).all(1); W=np.isin(w,veh); ok=~np.isin(w,ign)
    base=dict(tp=int((G&W&ok).sum()),fp=int((G&~W&ok).sum()),fn=int((W&~G&ok).sum()))
    return base,(rows_of(p,g,pr,G,W,ok) if G.any() else [])
def rows_of(p,g,pr,G,W,ok):
    rows=[]
    gp=p[np.isin(g,grd)]
    q=p[G]; lab,n=comps(q[:,:2]); 
    gc={}
    for k,z in zip(map(tuple,np.floor(gp[:,:2]/3).astype(int)),gp[:,2]): gc.setdefault(k,[]).append(z)
    gc={k:np.median(v) for k,v in gc.items()}
    order=np.argsort(lab,kind='stable'); bounds=np.searchsorted(lab[order],np.arange(n+1))
    wG=W[G]; okG=ok[G]; prG=pr[G]
    for i in range(n):
        idx=order[bounds[i]:bounds[i+1]]; a=q[idx]
        m=a[:,:2].mean(0); c=a[:,:2]-m
        if len(a)>=3:
            u,s,v=np.linalg.svd(c,full_matrices=False); pp=c@v.T; L=np.ptp(np.percentile(pp[:,0],[5,95])); Wd=np.ptp(np.percentile(pp[:,1],[5,95]))
        else: L=Wd=0
        k=np.floor(m/3).astype(int); zs=[gc[(k[0]+x,k[1]+y)] for x in(-1,0,1) for y in(-1,0,1) if (k[0]+x,k[1]+y) in gc]
        gz=np.median(zs) if zs else np.nan
        lo,hi=np.percentile(a[:,2],[5,95])
        pc=np.clip(prG[idx],.02,.998)
        rows.append((len(a),int((wG[idx]&okG[idx]).sum()),int((~wG[idx]&okG[idx]).sum()),np.log(pc/(1-pc)).mean(),L,Wd,hi-lo,lo-gz,hi-gz,np.linalg.norm(m)))
    return rows
if __name__=='__main__':
    rec,seg,out=map(pathlib.Path,sys.argv[1:4]); step=int(sys.argv[4]) if len(sys.argv)>4 else 1
    res=[]
    for f in sorted((rec/'labels').glob('*.label'))[::step]:
        if (seg/'labels'/(f.stem+'.label')).exists(): res.append((f.stem,)+features(rec,seg,f.stem))
    pickle.dump(res,open(out,'wb'))
    b={k:sum(r[1][k] for r in res) for k in('tp','fp','fn')}; print(rec.name,len(res),b,'IoU',b['tp']/(b['tp']+b['fp']+b['fn']),'pieces',sum(len(r[2]) for r in res))
