#!/usr/bin/env python3
"""Prints when a window of the room shows what, on an X server without a screen (Xvfb) whose memory is compared every 20 ms.

    desktop/first_picture.py CACHE [SECONDS]

CACHE is the folder for the driver's compiled kernels: an empty one for a first run, the same again for a later one. The
window is closed after SECONDS (20). Times are from the program's start; a picture is a change in the middle of the screen
that has more than 300 colours. The program is target/release/glimpse, or $GLIMPSE.
"""
import mmap
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import time

WIDTH, HEIGHT = 1280, 720
MIDDLE = slice(4 * WIDTH * 100, 4 * WIDTH * 560)


def pixels(screen):
    """The pixels of an X window dump: its header's size is word 0, the number of colours of 12 bytes word 19."""
    header, = struct.unpack(">I", screen[0:4])
    colours, = struct.unpack(">I", screen[76:80])
    return screen[header + 12 * colours:]


def main():
    cache, seconds = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 20.0
    root = pathlib.Path(__file__).resolve().parent.parent
    program = os.environ.get("GLIMPSE", root / "target/release/glimpse")
    with tempfile.TemporaryDirectory() as folder:
        reading, writing = os.pipe()
        server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-nolisten", "tcp",
             "-noreset", "-fbdir", folder], pass_fds=[writing], stderr=subprocess.DEVNULL)
        display = os.read(reading, 16).decode().strip()
        environment = {**os.environ, "DISPLAY": f":{display}", "MESA_SHADER_CACHE_DIR": cache}
        start = time.time()
        window = subprocess.Popen([program, "view", "builtin:room", "--size", f"{WIDTH}x{HEIGHT}"], env=environment)
        try:
            watch(pathlib.Path(folder) / "Xvfb_screen0", start, seconds)
        finally:
            window.terminate()
            window.wait()
            server.terminate()
            server.wait()


def watch(file, start, seconds):
    last, since, pictures, longest = None, start, [], 0.0
    with open(file, "rb") as opened, mmap.mmap(opened.fileno(), 0, access=mmap.ACCESS_READ) as screen:
        while time.time() < start + seconds:
            now, shown = time.time() - start, pixels(screen)
            middle = shown[MIDDLE]
            if last is not None and shown != last[0]:
                if middle != last[1] and len({middle[i:i + 3] for i in range(0, len(middle), 4 * 37)}) > 300:
                    pictures.append(now)
                elif len(pictures) < 2:
                    longest = max(longest, now - since)
                since = now
            last = (shown, middle)
            time.sleep(0.02)
    print("pictures at", ", ".join(f"{now:.2f} s" for now in pictures))
    print(f"longest time without a repaint before the last of them {longest:.2f} s")


if __name__ == "__main__":
    main()
