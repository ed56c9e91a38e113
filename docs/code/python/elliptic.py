from pendula import elliptic

print(elliptic.K(0.5), elliptic.K_series(0.5, terms=8), elliptic.K(kc=1e-200))
print(elliptic.sncndn(1.0, 0.5).sn, elliptic.am(1.0, 0.5), elliptic.F(1.0, 0.5), elliptic.E(0.5))
