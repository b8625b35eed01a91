import numpy as np,pathlib,sys,pickle
sys.argv0=sys.argv; import vp, vfit
which=vfit.ALL if len(sys.argv)<2 or sys.argv[1]=='all' else [k for k in vfit.ALL if k not in('lo','lo2','hi','hi2')]
m=vfit.fit(vfit.data(['sim']),which); b,mu,sd=m
for rec in ('kitti_object','pandaset_002'):
    R=pathlib.Path('/tmp/data')/rec; S=pathlib.Path(f'/tmp/seg46_{rec}'); O=pathlib.Path(f'/tmp/segv_{rec}'); (O/'labels').mkdir(parents=True,exist_ok=True)
    for f in sorted((S/'labels').glob('*.label')):
        g=np.fromfile(f,'<u4'); p=np.fromfile(R/'velodyne'/(f.stem+'.bin'),'<f4').reshape(-1,4)[:,:3]
        G=np.isin(g&0xFFFF,vp.veh)&np.isfinite(p).all(1)
        if G.any():
            # same comps
            q=p[G]; lab,n=vp.comps(q[:,:2])
            rows=vp.rows_of(p,g&0xFFFF,np.fromfile(S/'probability'/(f.stem+'.f32'),'<f4'),G,np.zeros(len(p),bool),np.ones(len(p),bool))
            pr=1/(1+np.exp(-((vfit.X(rows,which)-mu)/sd)@b)); drop=np.flatnonzero(pr<.5)
            gg=g[G]; gg[np.isin(lab,drop)]=0; g[G]=gg
        g.tofile(O/'labels'/f.name)
