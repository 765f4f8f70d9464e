# A procedure for other scenes: a tree of branches below "depth" forks. All forks of one level share what grows on them, so
# the tree costs memory for one branch only.
proc grow {depth bark leaf} {
  set branch [SippObjectCreate]
  set wood [SippCone 0.1 0.07 1 10 $bark]
  SippObjectMove $wood {0 0 0.5}
  SippObjectAddSubobj $branch $wood
  if {$depth == 0} {
    set crown [SippEllipsoid {0.35 0.35 0.45} 8 $leaf]
    SippObjectMove $crown {0 0 1.2}
    SippObjectAddSubobj $branch $crown
    return $branch
  }
  set next [grow [expr {$depth - 1}] $bark $leaf]
  foreach {tilt turn size} {32 20 0.72 36 140 0.7 30 260 0.74} {
    set fork [SippObjectCreate]
    SippObjectAddSubobj $fork $next
    SippObjectScale $fork $size
    SippObjectRotateY $fork D$tilt
    SippObjectRotateZ $fork D$turn
    SippObjectMove $fork {0 0 0.95}
    SippObjectAddSubobj $branch $fork
  }
  return $branch
}
