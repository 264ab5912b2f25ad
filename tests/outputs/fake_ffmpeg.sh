#!/bin/sh
# Stands for ffmpeg in tests. FAKE says how it behaves; what it was asked and got is kept in the
# folder where it runs.
case " $* " in
*" -encoders "*)
    [ "$FAKE" = broken ] && { echo "error while loading shared libraries" >&2; exit 127; }
    echo " V....D libx265              libx265 H.265 / HEVC"
    # The name in a description is no encoder.
    echo " V....D h264_other           not libx264"
    [ "$FAKE" = no-encoder ] || echo " V....D libx264              libx264 H.264 / AVC (codec h264)"
    exit 0
    ;;
esac
printf '%s\n' "$@" >arguments.txt
for last; do :; done
film=${last#file:}
[ -e "$film" ] || { echo "no hidden file at $film" >&2; exit 9; }
complain() {
    count=0
    while [ $count -lt 5000 ]; do
        echo "complaint $count: the quick brown fox jumps over the lazy dog" >&2
        count=$((count + 1))
    done
}
case $FAKE in
good)
    # More than a pipe holds, before and after.
    complain
    cat >bytes.bin
    complain
    # Three boxes of nothing but their heads, the last two of the longer kind.
    printf '\000\000\000\010ftyp' >"$film"
    printf '\000\000\000\001moov\000\000\000\000\000\000\000\020' >>"$film"
    printf '\000\000\000\000mdat....' >>"$film"
    ;;
cut-off)
    # As of one that finds the disk full when it closes the film.
    cat >/dev/null
    printf '\000\000\000\010ftyp\000\000\000\010mdat\000\000\000\020moov' >"$film"
    echo "Error closing file: No space left on device" >&2
    ;;
at-once)
    echo "unknown option in $last" >&2
    exit 7
    ;;
half-way)
    head -c 200000 >/dev/null
    printf half >"$film"
    echo "no space left on device" >&2
    exit 1
    ;;
at-end)
    cat >/dev/null
    printf most >"$film"
    complain
    exit 1
    ;;
killed)
    head -c 200000 >/dev/null
    kill -KILL $$
    ;;
deaf)
    # Takes no more and does not end.
    exec sleep 60 <&-
    ;;
leaves-one-behind)
    sleep 60 <&- &
    echo "the last word" >&2
    exit 3
    ;;
nothing) cat >/dev/null ;;
esac
