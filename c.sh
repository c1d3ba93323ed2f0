# click at picture coordinates
. /tmp/h/cold25/env.sh; . ./disp
x=$(awk "BEGIN{print int($1*1.3187)}"); y=$(awk "BEGIN{print int($2*1.3187)}"); xdotool mousemove $x $y click ${3:-1}
