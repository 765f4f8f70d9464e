// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_sipp/script.h"

namespace farop::sipp {

// Written anew from what the commands of Extended Tcl are documented to do.
const char* const k_tclx_prelude = R"tcl(
# Tcl defines these two in its library of scripts, which is not loaded.
proc ::tcl::mathfunc::min {x args} {foreach a $args {if {$a < $x} {set x $a}}; return $x}
proc ::tcl::mathfunc::max {x args} {foreach a $args {if {$a > $x} {set x $a}}; return $x}
proc loop {variable from to args} {
  switch [llength $args] {
    1 {set step 1; set body [lindex $args 0]}
    2 {lassign $args step body; set step [uplevel 1 [list expr $step]]}
    default {error "loop: expected variable from to ?step? body"}
  }
  if {$step == 0} {error "loop: the step is 0"}
  upvar 1 $variable i
  set from [uplevel 1 [list expr $from]]
  set to [uplevel 1 [list expr $to]]
  for {set i $from} {$step > 0 ? $i < $to : $i > $to} {incr i $step} {uplevel 1 $body}
}
proc lempty {list} {expr {[string trim $list] eq ""}}
proc lvarpop {variable {index 0} args} {
  upvar 1 $variable list
  set element [lindex $list $index]
  if {[llength $args]} {
    set list [lreplace $list $index $index [lindex $args 0]]
  } else {
    set list [lreplace $list $index $index]
  }
  return $element
}
proc lvarpush {variable element {index 0}} {
  upvar 1 $variable list
  if {![info exists list]} {set list {}}
  set list [linsert $list $index $element]
  return
}
proc cindex {text index} {string index $text $index}
proc crange {text first last} {string range $text $first $last}
proc clength {text} {string length $text}
proc cexpand {text} {subst -nocommands -novariables $text}
proc echo {args} {puts [join $args " "]}
proc min {args} {expr "min([join $args ,])"}
proc max {args} {expr "max([join $args ,])"}
proc random {limit {seed 1}} {
  if {$limit eq "seed"} {expr {srand($seed)}; return}
  expr {int(rand() * $limit)}
}
expr {srand(1)}
proc keylset {variable args} {
  upvar 1 $variable list
  if {![info exists list]} {set list {}}
  foreach {key value} $args {
    set path [split $key .]
    set head [lindex $path 0]
    set at [lsearch -exact -index 0 $list $head]
    if {[llength $path] > 1} {
      set inner [expr {$at < 0 ? "" : [lindex $list $at 1]}]
      keylset inner [join [lrange $path 1 end] .] $value
      set value $inner
    }
    if {$at < 0} {lappend list [list $head $value]} else {lset list $at [list $head $value]}
  }
  return
}
proc keylget {variable {key ""} args} {
  upvar 1 $variable list
  if {$key eq ""} {return [keylkeys list]}
  set value $list
  set found 1
  foreach part [split $key .] {
    set at [lsearch -exact -index 0 $value $part]
    if {$at < 0} {set found 0; break}
    set value [lindex $value $at 1]
  }
  if {![llength $args]} {
    if {!$found} {error "keylget: the key '$key' is not in '$variable'"}
    return $value
  }
  if {$found && [lindex $args 0] ne ""} {upvar 1 [lindex $args 0] result; set result $value}
  return $found
}
proc keylkeys {variable {key ""}} {
  upvar 1 $variable list
  set value [expr {$key eq "" ? $list : [keylget list $key]}]
  set keys {}
  foreach pair $value {lappend keys [lindex $pair 0]}
  return $keys
}
proc keyldel {variable key} {
  upvar 1 $variable list
  set path [split $key .]
  set head [lindex $path 0]
  set at [lsearch -exact -index 0 $list $head]
  if {$at < 0} {error "keyldel: the key '$key' is not in '$variable'"}
  if {[llength $path] == 1} {
    set list [lreplace $list $at $at]
    return
  }
  set inner [lindex $list $at 1]
  keyldel inner [join [lrange $path 1 end] .]
  if {[llength $inner]} {
    lset list $at [list $head $inner]
  } else {
    set list [lreplace $list $at $at]
  }
  return
}
foreach f {acos asin atan ceil cos cosh exp floor log log10 sin sinh sqrt tan tanh abs double int round} {
  proc $f {x} [string map [list F $f] {uplevel 1 [list expr "F($x)"]}]
}
foreach f {fmod pow atan2 hypot} {
  proc $f {x y} [string map [list F $f] {uplevel 1 [list expr "F($x, $y)"]}]
}
unset f
)tcl";

}  // namespace farop::sipp
