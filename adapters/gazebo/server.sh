# Run by adapters/gazebo/run where Gazebo is: WORLD SECONDS CAMERA ROS OUT. A gzserver from beginning to end, with
# ports of its own; what it starts it ends.
# shellcheck shell=bash disable=SC1091
set -uo pipefail
world=$1 time_limit=$2 camera=$3 ros=$4 out=$5
log=$out/server.log
children=()

say() { printf '%s\n' "$*" >&2; }

end_children() {
    local child
    for child in "${children[@]}"; do
        kill -TERM "$child" 2>/dev/null
    done
    for child in "${children[@]}"; do
        timeout 5 tail --pid="$child" -f /dev/null || kill -KILL "$child" 2>/dev/null
    done
}
trap end_children EXIT
trap 'exit 130' INT TERM HUP

# free_port FIRST: nobody listens there now
free_port() {
    local port
    for ((port = $1; port < $1 + 200; port++)); do
        if ! (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; then
            echo "$port"
            return
        fi
    done
    return 1
}

set +u  # Gazebo's own script does not care
. /usr/share/gazebo/setup.sh
set -u
plugins=build/bullseye
export GAZEBO_IP=127.0.0.1 IGN_IP=127.0.0.1 GAZEBO_MODEL_DATABASE_URI='' ALSOFT_DRIVERS=null
export GAZEBO_PLUGIN_PATH=$PWD/$plugins:$GAZEBO_PLUGIN_PATH
export GAZEBO_RESOURCE_PATH=${world%/*}:$GAZEBO_RESOURCE_PATH  # materials are next to the world
port=$(free_port $((12000 + RANDOM % 8000))) || { say "limpet: no free port for Gazebo's master"; exit 1; }
export GAZEBO_MASTER_URI=http://127.0.0.1:$port

if [ "$ros" = yes ]; then
    port=$(free_port $((21000 + RANDOM % 8000))) || { say "limpet: no free port for ROS's master"; exit 1; }
    export ROS_MASTER_URI=http://127.0.0.1:$port ROS_IP=127.0.0.1
    say "  ROS master: $ROS_MASTER_URI"
    roscore -p "$port" >"$out/roscore.log" 2>&1 &
    children+=($!)
    for ((i = 0; i < 200; i++)); do
        rostopic list >/dev/null 2>&1 && break
        sleep 0.1
    done
    rostopic list >/dev/null 2>&1 || { say "limpet: ROS's master does not come up; $out/roscore.log"; exit 1; }
fi

display=()
[ "$camera" = no ] || display=(xvfb-run -a -s '-screen 0 1280x1024x24' env LIBGL_ALWAYS_SOFTWARE=1)
# The plugin prints the flight on standard output; the pipe is marked with real time for the picture.
coproc server { exec timeout -k 5 "$time_limit" "${display[@]}" gzserver "$world" 2>"$log"; }
children+=("$server_PID")
pid=$server_PID
while IFS= read -r line; do
    printf '%s\n' "$line"
    [[ $line =~ ^\ +[0-9.]+\ +(perched|motors_on)\  ]] && touch "$out/.${BASH_REMATCH[1]}"
done <&"${server[0]}"
wait "$pid"
code=$?
unset "children[-1]"
case $code in
    0) ;;
    124 | 137) say "limpet: gzserver did not end within $time_limit s (--time-limit); $log"; exit 1 ;;
    2) grep '^limpet: ' "$log" >&2; exit 2 ;;
    *)
        if [ -s "$LIMPET_RESULT" ] && grep -q 'thread: trying joining itself' "$log"; then
            # now and then, as it takes itself down after a flight that is printed and recorded:
            # gazebo-classic, issue 2019
            code=0
        elif grep -q 'Address already in use' "$log"; then
            say "limpet: port ${GAZEBO_MASTER_URI##*:} was taken meanwhile; once more, please"
        else
            tail -n 5 "$log" >&2
            say "limpet: gzserver ended with $code; $log"
        fi
        [ "$code" -eq 0 ] || exit 1
        ;;
esac
[ -s "$LIMPET_RESULT" ] || { say "limpet: gzserver ended before the flight did; $log"; exit 1; }
