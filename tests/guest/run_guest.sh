#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run_guest.sh FOLDER SCRIPT RESULTS: runs SCRIPT in the guest that make_guest.sh built, where the folder RESULTS is
# /run/results. Exits with the status of SCRIPT, or with 77 and a message if no guest can run with this computer's files. The
# guest uses no hardware virtualisation, so it runs everywhere. Its clock counts its own instructions (2 ns each) and jumps ahead
# while it sleeps, so a busy computer makes the run longer and changes nothing else. It shows that things work, not how fast they are.
set -euo pipefail
folder=$(cd "$1" && pwd) results=$(mkdir -p "$3" && cd "$3" && pwd)
realpath "$2" >"$results/script"   # not on the kernel's command line, where a space would end it
log=$results/console.log
# The limit is on the time of the processor, because a busy computer may take ten times as long. The guest has one processor: in this
# mode several take turns, and the kernel does not start in a minute.
boot ()
{
    (ulimit -t "${GUEST_CPU_SECONDS:-1200}" && exec qemu-system-x86_64 -M q35 -accel tcg,thread=single -icount shift=1,sleep=off -cpu max -smp 1 -m 1024 \
        -nodefaults -no-reboot \
        -display none -serial "file:$log" -monitor none \
        -kernel "$folder"/kernel/boot/vmlinuz-* -initrd "$folder/root.cpio.gz" \
        -append "console=ttyS0 quiet panic=-1 tsc=reliable mitigations=off random.trust_cpu=on" \
        -virtfs local,path=/,mount_tag=host,security_model=none,readonly=on,multidevs=remap \
        -virtfs "local,path=${results//,/,,},mount_tag=results,security_model=none" 2>"$results/qemu.txt") || true
    cat "$results/qemu.txt" >&2
}
isUp () { grep -q GUEST_UP "$log" 2>/dev/null; }

# If the guest does not start, nothing has been tested, so it is started once more. A guest that starts is never run again,
# whatever the result.
for _ in 1 2; do
    boot
    isUp && break
    echo "the guest did not start" >&2
done
if ! isUp; then
    echo "skipped: no guest can run here: $({ tail -n 1 "$results/qemu.txt"; tail -n 1 "$log" 2>/dev/null; } | tr -d '\r' | tr '\n' ' ')"
    exit 77
fi
result=$(tr -d '\r' <"$log" | sed -n 's/^GUEST_RESULT=//p')
if [ "${result:-99}" -ne 0 ]; then tail -40 "$log" >&2; fi
exit "${result:-99}"
