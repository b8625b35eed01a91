import numpy as np,pickle,sys
def X(rows,which):
    r=np.array(rows,float); n,l,L,W,H,lo,hi,R=r[:,0],r[:,3],r[:,4],r[:,5],r[:,6],r[:,7],r[:,8],r[:,9]
    lo=np.nan_to_num(lo,nan=0.5); hi=np.nan_to_num(hi,nan=1.0)
    px=np.log(n*R*R/1e3+1e-3)  # ~ area seen
    lL,lW,lH=np.log(L+.2),np.log(W+.1),np.log(H+.1)
    F=dict(one=np.ones(len(r)),logit=l,n=np.log(n),L=lL,L2=lL**2,W=lW,W2=lW**2,H=lH,H2=lH**2,lo=lo,lo2=lo**2,hi=hi,hi2=hi**2,R=np.log(R+1),LW=lL*lW)
    return np.stack([F[k] for k in which],1)
ALL='one logit n L L2 W W2 H H2 lo lo2 hi hi2 R LW'.split()
def data(names): return [r for n in names for s in pickle.load(open(f'/tmp/vp_{n}.pkl','rb')) for r in s[2] if r[1]+r[2]>0]
def fit(rows,which,power=.5,l2=1e-2):
    r=np.array(rows,float); x=X(rows,which); mu=x.mean(0); sd=x.std(0); sd[0]=1; mu[0]=0; sd[sd==0]=1; z=(x-mu)/sd
    n=r[:,1]+r[:,2]; y=r[:,1]/n; w=n**power; w/=w.mean(); b=np.zeros(z.shape[1])
    for _ in range(30):
        p=1/(1+np.exp(-z@b)); g=z.T@(w*(y-p))-l2*len(y)*np.r_[0,b[1:]]*0.01; Hh=(z*(w*p*(1-p))[:,None]).T@z+l2*len(y)*.01*np.eye(len(b)); b=b+np.linalg.solve(Hh,g)
    return b,mu,sd
def iou(name,m,which,t=.5):
    b,mu,sd=m; tp=fp=fn=0; b0=[0,0,0]
    for s in pickle.load(open(f'/tmp/vp_{name}.pkl','rb')):
        base,rows=s[1],s[2]; b0=[b0[0]+base['tp'],b0[1]+base['fp'],b0[2]+base['fn']]
        if not rows: fn+=base['fn']; continue
        p=1/(1+np.exp(-((X(rows,which)-mu)/sd)@b)); r=np.array(rows,float); keep=p>=t
        tp+=r[keep,1].sum(); fp+=r[keep,2].sum(); fn+=base['fn']+r[~keep,1].sum()
    return b0[0]/sum(b0),tp/(tp+fp+fn),tp/(tp+fp),tp/(tp+fn)
if __name__=='__main__':
    real=['sk','semantic_kitti_00','semantic_kitti_08','nuscenes_trucks','pandaset_002']
    sim=data(['sim']); print(len(sim))
    for which in (ALL,[k for k in ALL if k not in('lo','lo2','hi','hi2')],['one','logit'],['one','logit','n','H','H2','L','L2','W','W2'],['one','logit','hi','hi2','lo','lo2']):
        m=fit(sim,which); print(len(which),which)
        for n in ['sim']+real: print('   ',n,' '.join('%.3f'%v for v in iou(n,m,which)))
    # leave one out on real
    for i,n in enumerate(real):
        m=fit(data([r for r in real if r!=n]),ALL); print('real LOO',n,' '.join('%.3f'%v for v in iou(n,m,ALL)))
