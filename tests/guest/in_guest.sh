#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs in the guest, in a folder that test_devices.sh makes, with devices from guest_device and the programs built on this computer. Results go
# to /run/results, where check.py reads them. All times are those of the guest's clock. It does not depend on how busy this computer is, but it
# runs ahead while the guest waits for a file of this computer: a page of a program that is read then would look like a program that hangs. So all
# programs and libraries are read before a device exists, and waits are long: they cost little.
cd "$(dirname "$0")/../.."
work=$(mktemp -d -p /var/tmp)   # in memory; it disappears with the guest
chmod a+rx "$work"
tactus=build/release/bin/tactus
device=build/release/bin/guest_device
descriptor=$PWD/descriptor   # if the recording of a joystick's is there
export HOME=$work
# The tool seems to move many times faster than it does where reports are lost, and after the board was unplugged.
mkdir -p $work/profiles
sed -e 's/"max_speed": "2 m\/s"/"max_speed": "100 m\/s"/' \
    -e 's/"id": "tactus_board",/&\n  "replaces": "tactus_board",/' host/devices/profiles/tactus_board.json >$work/profiles/tactus_board.json
export TACTUS_PROFILES=$work/profiles
sed 's/"max_speed": "2 m\/s"/"max_speed": "100 m\/s"/' graphs/dry_wood.json >$work/dry_wood.json   # the graph's limit counts, too
failures=0
say () { echo "== $*"; echo "$SECONDS $*" >>/run/results/times.txt; }
fail () { echo "FAILED: $*"; failures=$((failures + 1)); }

wait_for () { for _ in $(seq 6000); do compgen -G "$1" >/dev/null && return; sleep 0.1; done; fail "$1 did not appear"; }
gone () { for _ in $(seq 100); do compgen -G '/dev/hidraw*' >/dev/null || return; sleep 0.1; done; }

# plug OPTIONS…: plugs in a board, until `unplug`. Its log is $work/board.csv.
plug () { gone; $device board --seconds 3000 --log $work/board.csv "$@" & sim=$!; wait_for '/dev/hidraw*'; }
unplug () { kill -TERM $sim; wait $sim; }

# keep NAME: keeps the results of the run under this name.
keep () { local f; for f in board.csv play.csv play.err; do [ -e $work/$f ] && mv $work/$f "/run/results/$1.$f"; done; }

play () { $tactus play $work/dry_wood.json --device stylus=hid:tactus_board --osc off "$@" 2>$work/play.err; }
to_player () { kill -"$1" "$(pgrep -x tactus | head -1)"; }
wait_for_words () { for _ in $(seq 6000); do grep -q "$1" $work/play.err && return; sleep 0.1; done; fail "play did not say $1"; }
# end_under_force SIGNAL: sends SIGNAL to the playing program once the device has received forces. Then waits until no process
# has the device open, including the guardian that sends the neutral reports.
end_under_force ()
{
    wait_for "$work/pushed"
    to_player "$1"
    wait $player
    for _ in $(seq 100); do pgrep ^tactus >/dev/null || break; sleep 0.1; done
    rm -f $work/pushed
}

recorded=(--record hand.position,motor.force,motor.applied --out $work/play.csv)

say "programs and libraries are read into memory"
programs=(build/release/bin/* build/release/lib/tactus/plugins/* plugins/* /usr/bin/python3)
for tool in awk bash cat chmod cp grep head ls mkdir mv pgrep pkill rm sed seq setpriv sleep sort tail wc; do programs+=("$(type -P $tool)"); done
[ -d build/release/python ] && readarray -t -O ${#programs[@]} programs < <(
    find build/release/python/ /usr/lib/python3/dist-packages/numpy /usr/lib/python3.*/lib-dynload -name '*.so'
    find /usr/lib/python3.*/ -maxdepth 3 -path '*__pycache__*' -o -maxdepth 1 -name '*.py')
cat "${programs[@]}" $(ldd "${programs[@]}" 2>/dev/null | grep -o '/[^ :]*' | sort -u) >/dev/null 2>&1

say "nothing connected"
$device board --describe 1 >/dev/null
$tactus devices >/run/results/none.txt || fail "tactus devices without a device"

say "a closed loop"
plug --wait 1
play --duration 3 "${recorded[@]}" || fail "the closed loop"
unplug
keep loop

say "reports that are lost, malformed, short, too long, out of order, and a stall"
plug --wait 1 --drop 37 --malformed 701 --short 811 --oversized 907 --swap 401 --stall 1500
play --duration 3 "${recorded[@]}" || fail "the faulty board"
unplug
keep faults

say "unplugged while a force acts, and plugged in again"
plug --unplug 800 --away 1.5
play --duration 5 "${recorded[@]}" || fail "the unplugged board"
unplug
keep unplug

for signal in INT TERM KILL SEGV; do
    say "ended by $signal while a force acts"
    plug --mark $work/pushed
    play --duration 600 & player=$!
    end_under_force $signal
    unplug
    keep "$signal"
done

say "frozen under force, and continued"
plug --mark $work/pushed
play --duration 600 & player=$!
wait_for "$work/pushed"
to_player STOP
sleep 3   # the guardian needs 0.1 s
to_player CONT
wait_for_words run/frozen
sleep 2   # the device is opened again, and gets no force
end_under_force INT
unplug
keep STOP

say "its guardian is killed under force, and then the program"
plug --mark $work/pushed
play --duration 600 & player=$!
wait_for "$work/pushed"
kill -KILL "$(pgrep -x force-guardian)"
wait_for_words run/unguarded
sleep 1
end_under_force KILL
unplug
keep guardian

# Programs of others, which play through libtactus_live.
own () { build/release/bin/own_program $work/dry_wood.json "$1" 2>$work/play.err; }
script () { PYTHONPATH=build/release/python /usr/bin/python3 -B tests/guest/own_script.py $work/dry_wood.json "$1" 2>$work/play.err; }
# attack NAME PROGRAM WHAT [SIGNAL]: plays with WHAT; once the board has received forces, sends SIGNAL, or waits until the program ends by itself.
attack ()
{
    say "an own program: $1"
    plug --mark $work/pushed
    $2 "$3" & player=$!
    wait_for "$work/pushed"
    rm -f $work/pushed
    if [ -n "${4:-}" ]; then
        sleep 0.3
        kill -"$4" "$(pgrep -f "own_(program|script).* $3\$" | head -1)"
        [ "$4" = STOP ] && { sleep 1; kill -KILL "$(pgrep -f "own_(program|script).* $3\$" | head -1)"; }
    elif [ "$3" = hang ]; then
        sleep 3
        kill -KILL "$(pgrep -f "own_program.* hang\$" | head -1)"
    fi
    wait $player
    sleep 0.5
    unplug
    pkill -f 'own_program.* fork'
    keep "own_$1"
}
for signal in KILL HUP STOP; do attack $signal own play $signal; done
for what in close fault abort hang; do attack $what own $what; done
for what in fork two; do attack $what own $what KILL; done
if [ -d build/release/python ]; then
    (cd / && PYTHONPATH=$OLDPWD/build/release/python /usr/bin/python3 -B -c 'import tactus, numpy; tactus._play.live()')   # reads the files once
    for what in raise exit; do attack script_$what script $what; done
    attack script_KILL script play KILL
fi

# The board again, driven by a device driver in a plugin.
driven () { $tactus play $work/dry_wood.json --device "stylus=hidraw_board:$(compgen -G '/dev/hidraw*')" --plugins plugins --rate 1000 --osc off "$@" 2>$work/play.err; }
say "a driver in a plugin: a closed loop"
plug --wait 1
driven --duration 3 "${recorded[@]}" || fail "the closed loop of a driver"
unplug
keep driver_loop
for signal in INT KILL STOP hang; do
    say "a driver in a plugin: $signal while a force acts"
    plug --mark $work/pushed
    if [ $signal = hang ]; then
        TACTUS_TEST_HANG=1 driven --duration 600 & player=$!
        wait_for_words run/frozen
        sleep 1
        end_under_force KILL
    else
        driven --duration 600 & player=$!
        if [ $signal = STOP ]; then
            wait_for "$work/pushed"
            to_player STOP
            sleep 1
            end_under_force KILL
        else
            end_under_force $signal
        fi
    fi
    unplug
    keep driver_$signal
done

# The board of fake-device. The program has a different name from the one that plays.
ln -s "$PWD/$tactus" $work/fake
inputs=$(compgen -G '/sys/class/input/event*' | wc -l)
pretend () { gone; $work/fake fake-device tactus_board --wire hid --log $work/fake.log "$@" >$work/fake.txt 2>&1 & sim=$!; wait_for '/dev/hidraw*'; }
keep_fake () { unplug; mv $work/fake.log "/run/results/$1.fake.log"; mv $work/fake.txt "/run/results/$1.fake.txt"; keep "$1"; }
say "fake-device as a HID device: a closed loop"
pretend
play --duration 3 "${recorded[@]}" || fail "the closed loop with fake-device"
keep_fake fake_loop

say "fake-device as a HID device: half reports, unplugged and plugged in again, and its player killed"
pretend --fault half@4:0.05 --fault away@5:0.5
play --duration 600 & player=$!
for _ in $(seq 6000); do   # its time is the number of its steps
    tail -n 1 $work/fake.log | awk '{ exit $1 < 9000 }' && tail -n 50 $work/fake.log | grep -q '< 54 01 01' && break
    sleep 0.1
done
to_player KILL
wait $player
sleep 0.5
keep_fake fake_faults

say "fake-device with a profile that says it is a keyboard"
sed -e 's/"id": "woodenhaptics_usb"/"id": "keys"/' \
    -e 's/"vid": "0x1234", "pid": "0x0006"/"vid": "0x1209", "pid": "0x0001", "usage_page": "0x0001", "usage": "0x0006"/' \
    host/devices/profiles/woodenhaptics_usb.json >$work/profiles/keys.json
gone
$work/fake fake-device keys --duration 1 >/run/results/fake_keys.txt 2>&1 & sim=$!
wait_for '/dev/hidraw*'
sleep 0.5
[ "$(compgen -G '/sys/class/input/event*' | wc -l)" -eq "$inputs" ] || fail "fake-device is a keyboard"
wait $sim || fail "a device that says it is a keyboard"
rm $work/profiles/keys.json

say "fake-device as a HID device that the kernel has its own driver for"
gone
$work/fake fake-device dualsense_usb --duration 1 >/run/results/fake_dualsense.txt 2>&1
[ $? -eq 1 ] || fail "a DualSense of fake-device must be an error"
$work/fake fake-device woodenhaptics_usb --duration 1 >/run/results/fake_woodenhaptics.txt 2>&1 || fail "a WoodenHaptics arm of fake-device"

# gadget: creates a board on its own bus, behind the kernel's USB stack.
gadget=/sys/kernel/config/usb_gadget/board
make_gadget ()
{
    mount -t configfs none /sys/kernel/config 2>/dev/null
    mkdir $gadget || return
    echo 0x16c0 >$gadget/idVendor
    echo 0x0486 >$gadget/idProduct
    mkdir -p $gadget/strings/0x409 $gadget/configs/c.1 $gadget/functions/hid.0
    echo "G1" >$gadget/strings/0x409/serialnumber
    echo "Tactus test board" >$gadget/strings/0x409/product
    echo 0 >$gadget/functions/hid.0/subclass
    echo 0 >$gadget/functions/hid.0/protocol
    echo 64 >$gadget/functions/hid.0/report_length
    $device board --describe 1 >$gadget/functions/hid.0/report_desc
    ln -s $gadget/functions/hid.0 $gadget/configs/c.1/
    ls /sys/class/udc | head -1 >$gadget/UDC
}

say "a closed loop over USB"
if make_gadget; then
    wait_for '/dev/hidg0'
    wait_for '/dev/hidraw*'
    $device board --seconds 3000 --log $work/board.csv --wait 1 --gadget /dev/hidg0 & sim=$!
    play --duration 3 "${recorded[@]}" || fail "the closed loop over USB"
    unplug
    echo >$gadget/UDC
    keep usb
fi

if [ -e "$descriptor" ]; then
    ln -s "$descriptor" $work/descriptor
    stick () { gone; $device joystick --file $work/descriptor --seconds 3000 --log $work/board.csv "$@" & sim=$!; wait_for '/dev/hidraw*'; }
    feel () { $tactus play $work/dry_wood.json --osc off --rate 1000 "$@" 2>$work/play.err; }
    echo '{"driver": "hid", "profile": "pid", "calibration": {"full_force": "4 N", "travel": {"x": "12 cm", "y": "12 cm", "z": "12 cm"}}}' >$work/joystick.json

    say "a joystick with force feedback, driven through its own descriptor"
    stick
    feel --device stylus=$work/joystick.json --duration 2 "${recorded[@]}" || fail "the joystick"
    unplug
    keep joystick

    say "the same, not calibrated"
    stick
    feel --device stylus=hid:auto --duration 2 "${recorded[@]}" || fail "the joystick, not calibrated"
    unplug
    keep uncalibrated

    say "the same, unplugged while a force acts and plugged in again with another effect block"
    stick --unplug 1 --away 0.8
    feel --device stylus=$work/joystick.json --duration 4 "${recorded[@]}" || fail "the joystick, unplugged"
    unplug
    keep replugged

    say "the same, with no free effect block"
    stick --blocks 0
    feel --device stylus=hid:pid --duration 1
    [ $? -eq 1 ] || fail "a joystick without a free effect block must be an error"
    unplug
    keep no_room

    for answers in 1 0; do
        say "the same, resting and silent under a force; it says where it is when it is asked: $answers"
        stick --quiet 1.5 --answers $answers
        feel --device stylus=$work/joystick.json --duration 4 "${recorded[@]}" || fail "the joystick, silent"
        unplug
        keep quiet_$answers
    done

    say "the same, with its program killed while a force acts"
    stick --mark $work/pushed
    feel --device stylus=$work/joystick.json --duration 600 & player=$!
    end_under_force KILL
    unplug
    keep joystick_killed
fi

# Event devices. The stick at /dev/uinput has effects that it uploads and plays itself.
rub () { $tactus play $work/dry_wood.json --osc off --rate 1000 --device stylus=$work/wheel.json "$@" 2>$work/play.err; }
has_wheel () { grep -qsx "Test wheel" /sys/class/input/event*/device/name; }
turn ()
{
    for _ in $(seq 100); do has_wheel || break; sleep 0.1; done
    $device wheel --seconds 3000 --log $work/board.csv "$@" & sim=$!
    for _ in $(seq 6000); do has_wheel && return; sleep 0.1; done
    fail "the wheel did not appear"
}
echo '{"driver": "evdev", "port": "Test wheel", "max_rate": 1000,
       "calibration": {"full_force": "4 N", "travel": {"x": "12 cm", "y": "12 cm", "z": "12 cm"}}}' >$work/wheel.json
driver=build/release/lib/tactus/plugins/evdev.tactus-device
if [ -e /dev/uinput ] && [ -e $driver ]; then
    say "an event device: a closed loop"
    turn
    rub --duration 6 "${recorded[@]}" || fail "the closed loop of an event device"
    unplug
    keep wheel_loop

    say "an event device: listed, probed, in use, and without permission"
    turn
    sleep 0.5
    $tactus devices >/run/results/events.txt || fail "tactus devices with an event device"
    $tactus devices --probe --duration 2 --json >/run/results/events.json || fail "tactus devices --probe with an event device"
    rub --duration 600 & player=$!
    for _ in $(seq 6000); do ls -l /proc/"$(pgrep -x tactus | head -1)"/fd 2>/dev/null | grep -q input/event && break; sleep 0.1; done
    $tactus play $work/dry_wood.json --osc off --rate 1000 --device stylus=$work/wheel.json --duration 1 2>/run/results/events_taken.txt
    [ $? -eq 1 ] || fail "an event device that another program is using must be an error"
    to_player INT
    wait $player
    mkdir -p $work/any
    cp -r "$tactus" build/release/lib graphs/dry_wood.json $work/any
    mkdir -p $work/any/bin && cp "$tactus" build/release/bin/force-guardian $work/any/bin
    chmod -R a+rX $work/any
    chmod 0600 /dev/input/event*
    nobody="setpriv --reuid=65534 --regid=65534 --clear-groups env HOME=/nonexistent"
    $nobody $work/any/bin/tactus devices >/run/results/events_denied.txt || fail "tactus devices without permission"
    $nobody $work/any/bin/tactus play $work/any/dry_wood.json --osc off --device "stylus=evdev:Test wheel" --duration 1 2>/run/results/events_denied_play.txt
    [ $? -eq 1 ] || fail "an event device that the user has no permission to open must be an error"
    unplug

    say "an event device: unplugged while a force acts, and plugged in again"
    turn --unplug 300 --away 1
    rub --duration 6 || fail "the event device that was unplugged"
    unplug
    keep wheel_unplug

    say "an event device: its driver in the kernel does not return from an update"
    turn --hang 300 --for 1
    rub --duration 5
    unplug
    keep wheel_hang

    for signal in INT KILL STOP; do
        say "an event device: $signal while a force acts"
        turn --mark $work/pushed
        rub --duration 600 & player=$!
        if [ $signal = STOP ]; then
            wait_for "$work/pushed"
            to_player STOP
            sleep 1
            end_under_force KILL
        else
            end_under_force $signal
        fi
        unplug
        keep wheel_$signal
    done
fi

# Pads, which the kernel's own drivers rumble.
echo '{"format": "tactus-graph", "version": 2, "name": "Rumble", "rate_hz": 1000,
       "nodes": {"strong": {"type": "signal.lfo", "params": {"frequency": "80 Hz", "amplitude": 0.75}},
                 "weak": {"type": "signal.lfo", "params": {"frequency": "80 Hz", "amplitude": 0.25}},
                 "left": {"type": "device.signal_out", "role": "pad"}, "right": {"type": "device.signal_out", "role": "pad", "settings": {"channel": 2}}},
       "wires": ["strong.out -> left.in", "weak.out -> right.in"]}' >$work/rumble.json
# rumble NAME DRIVER PART: the pad that a driver of the kernel finds, with this part of a name
rumble ()
{
    [ -e $driver ] && [ -d /sys/bus/hid/drivers/"$2" ] || return
    say "a pad that rumbles: $1"
    $device "$1" --seconds 3000 --log $work/board.csv --mark $work/rests & sim=$!
    for _ in $(seq 60); do $tactus devices --json >$work/pads.txt; grep -q rumble $work/pads.txt && break; sleep 0.5; done
    cp $work/pads.txt "/run/results/$1.json"
    $tactus play $work/rumble.json --osc off --device "pad=evdev:$3" --duration 2 2>$work/play.err || fail "the pad $1"
    # The kernel sends the last report of a pad from a thread of its own. `check.py` judges a pad that never rests.
    for _ in $(seq 600); do [ -e $work/rests ] && break; sleep 0.1; done
    unplug
    rm -f $work/rests
    keep "$1"
}
rumble dualsense playstation "Test DualSense"
rumble switch_pro nintendo "Pro Controller"

say "several devices, listed and probed"
plug
$device space_mouse --seconds 3000 & mouse=$!
joystick=
count=2
[ -e "$descriptor" ] && { $device joystick --file "$descriptor" --seconds 3000 --log /dev/null & joystick=$!; count=3; }
for _ in $(seq 100); do [ "$(compgen -G '/dev/hidraw*' | wc -l)" -eq $count ] && break; sleep 0.1; done
$tactus devices >/run/results/devices.txt || fail "tactus devices"
$tactus devices --json >/run/results/devices.json || fail "tactus devices --json"
$tactus devices --probe --duration 2 --json >/run/results/probe.json || fail "tactus devices --probe"
$tactus devices --probe --duration 600 >/dev/null 2>&1 & other=$!
for _ in $(seq 6000); do ls -l /proc/$other/fd 2>/dev/null | grep -q hidraw && break; sleep 0.1; done
$tactus play graphs/dry_wood.json --device stylus=hid:tactus_board --osc off --duration 1 2>/run/results/taken.txt
[ $? -eq 1 ] || fail "a device that another program is using must be an error"
kill $other
wait $other
kill $mouse $joystick

say "a device that this user has no permission to open"
mkdir -p $work/any   # readable by everyone; the sources may not be
cp -r "$tactus" host/devices/profiles graphs/dry_wood.json $work/any
chmod -R a+rX $work/any
chmod 0600 /dev/hidraw* 2>/dev/null
as_nobody="setpriv --reuid=65534 --regid=65534 --clear-groups"
$as_nobody $work/any/tactus devices >/run/results/denied.txt || fail "tactus devices for a user without permission"
$as_nobody $work/any/tactus play $work/any/dry_wood.json --device stylus=hid:tactus_board --osc off --duration 1 2>/run/results/denied_play.txt
[ $? -eq 1 ] || fail "a device that the user has no permission to open must be an error"
unplug

cp $work/* /run/results/ 2>/dev/null
exit $failures
