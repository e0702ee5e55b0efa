#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make_guest.sh FOLDER: puts a kernel with uhid, uinput and an initial root file system into FOLDER. The guest's main root is this
# computer's, so that programs built here run in it unchanged, from whatever folder they are in. What the guest writes stays in its
# memory. Nothing is installed. Exits with status 77 and a message if no kernel is available.
set -euo pipefail
folder=$(mkdir -p "$1" && cd "$1" && pwd)
no_kernel () { echo "skipped: no kernel for the guest: $*"; exit 77; }

for tool in qemu-system-x86_64 busybox cpio depmod dpkg-deb; do
    command -v "$tool" >/dev/null || [ -x "/sbin/$tool" ] || no_kernel "$tool is missing"
done

if ! (cd "$folder" && compgen -G 'kernel/boot/vmlinuz-*' >/dev/null); then
    package=$(apt-cache depends linux-image-amd64 2>/dev/null | sed -n 's/.*Depends: \(linux-image-[0-9].*\)/\1/p' | tail -n 1)
    [ -n "$package" ] || no_kernel "apt does not know linux-image-amd64"
    rm -rf "$folder/kernel" "$folder/download"
    mkdir -p "$folder/download"
    (cd "$folder/download" && apt-get download "$package" >apt.log 2>&1) || no_kernel "$package cannot be downloaded"
    dpkg-deb -x "$folder"/download/linux-image-*.deb "$folder/kernel.part"
    rm -rf "$folder/download"
    mv "$folder/kernel.part" "$folder/kernel"
fi
version=$(basename "$folder"/kernel/boot/vmlinuz-*)
version=${version#vmlinuz-}

PATH=$PATH:/sbin
root=$folder/root
rm -rf "$root"
mkdir -p "$root"/{bin,modules,proc,sys,dev,host,memory,mnt}
[ -e "$folder/kernel/lib/modules/$version/modules.dep" ] || depmod -b "$folder/kernel" "$version"
cp "$(command -v busybox)" "$root/bin/busybox"
for module in virtio_pci 9pnet_virtio 9p overlay uhid hid-generic usbhid dummy_hcd usb_f_hid uinput evdev hid-playstation hid-nintendo; do
    modprobe -S "$version" -d "$folder/kernel" -D "$module" 2>/dev/null | sed -n 's/^insmod \(.*\.ko[^ ]*\).*/\1/p'
done | awk '! seen[$0]++' | while read -r file; do
    cp "$file" "$root/modules/"
    basename "$file" >>"$root/modules/order"
done

cat >"$root/init" <<'INIT'
#!/bin/busybox sh
b=/bin/busybox
$b mount -t proc proc /proc
$b mount -t sysfs sys /sys
$b mount -t devtmpfs dev /dev
for module in $($b cat /modules/order); do $b insmod "/modules/$module"; done
plan9=trans=virtio,version=9p2000.L,msize=262144
$b mount -t 9p -o $plan9,ro,cache=loose host /host
$b mount -t tmpfs tmpfs /memory
# over FOLDER: shows a folder of this computer at /mnt/FOLDER, and keeps in memory what the guest changes there.
over ()
{
    $b mkdir -p "/memory/$2/changes" "/memory/$2/work"
    $b mount -t overlay -o "lowerdir=/host/$1,upperdir=/memory/$2/changes,workdir=/memory/$2/work" overlay "/mnt/$1"
}
over . root
$b mount -t proc proc /mnt/proc
$b mount -t sysfs sys /mnt/sys
$b mount -o bind /dev /mnt/dev
$b mkdir -p /mnt/dev/shm
over dev/shm shm || $b mount -t tmpfs tmpfs /mnt/dev/shm
$b mkdir -p /mnt/run/udev /mnt/run/results
$b mount -t tmpfs tmpfs /mnt/run/udev   # the devices of this computer are not those of the guest
$b mount -t 9p -o $plan9 results /mnt/run/results
$b ip link set lo up
$b chroot /mnt /bin/bash -c ': >/run/results/up' && echo GUEST_UP
$b chroot /mnt /bin/bash "$($b cat /mnt/run/results/script)"
echo "GUEST_RESULT=$?"
$b sync
$b poweroff -f
INIT
chmod +x "$root/init"
(cd "$root" && find . | cpio -o -H newc 2>/dev/null | gzip -1) >"$folder/root.cpio.gz"
