#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run_guest.sh FOLDER SCRIPT RESULTS: runs SCRIPT in the guest of make_guest.sh, where the folder RESULTS is /run/results, and
# ends with its exit status; with 77, and a sentence, where there can be no guest that sees this computer's files. Without
# hardware help, so that it runs everywhere, some ten times as slow as here: what it shows is that things work, not how fast.
set -euo pipefail
folder=$(cd "$1" && pwd) script=$(realpath "$2") results=$(mkdir -p "$3" && cd "$3" && pwd)
log=$results/console.log
# no_timer_check: on a busy computer the guest's timer may be too late for the kernel's own test of it, which panics then.
boot ()
{
    timeout "${GUEST_TIMEOUT:-600}" qemu-system-x86_64 -M q35 -accel tcg,thread=multi -cpu max -smp 2 -m 1024 -nodefaults -no-reboot \
        -display none -serial "file:$log" -monitor none \
        -kernel "$folder"/kernel/boot/vmlinuz-* -initrd "$folder/root.cpio.gz" \
        -append "console=ttyS0 quiet panic=-1 no_timer_check tsc=reliable mitigations=off random.trust_cpu=on guest_script=$script" \
        -virtfs local,path=/,mount_tag=host,security_model=none,readonly=on,multidevs=remap \
        -virtfs "local,path=$results,mount_tag=results,security_model=none" 2>"$results/qemu.txt" || true
    cat "$results/qemu.txt" >&2
}
isUp () { grep -q GUEST_UP "$log" 2>/dev/null; }

# A guest that did not come up has tested nothing, and is started once more; one that did is not, whatever it found.
for _ in 1 2; do
    boot
    isUp && break
    echo "the guest did not come up" >&2
done
if ! isUp; then
    echo "skipped: no guest can run here: $({ tail -n 1 "$results/qemu.txt"; tail -n 1 "$log" 2>/dev/null; } | tr -d '\r' | tr '\n' ' ')"
    exit 77
fi
result=$(tr -d '\r' <"$log" | sed -n 's/^GUEST_RESULT=//p')
if [ "${result:-99}" -ne 0 ]; then tail -40 "$log" >&2; fi
exit "${result:-99}"
