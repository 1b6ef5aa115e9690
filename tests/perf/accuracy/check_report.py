"""Opens the report of a run in headless Chromium: points, pictures of a link, and requests.

usage: check_report.py PROGRAM FOLDER
Exits with 77 if there is no Chromium.
"""
import json
import os
import re
import shutil
import subprocess
import sys

from accuracy_runs import run, write_scenes
from png_pixels import read_png

# Added to a copy of the report: writes what the canvases show into the document.
PROBE = """<script>setTimeout(() => {
  const hash = (id) => {
    const canvas = document.getElementById(id), pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    let value = 2166136261;
    for (let i = 0; i < pixels.length; ++i) if (i % 4 !== 3) value = Math.imul(value ^ pixels[i], 16777619) >>> 0;
    return value;
  };
  document.body.append(Object.assign(document.createElement("pre"), {id: "probe",
    textContent: ["result", "reference", "difference"].map((name) => hash("picture-" + name)).join(" ")}));
}, 1500);</script>"""


def fnv(data):
    """FNV-1a [http://www.isthe.com/chongo/tech/comp/fnv] of 32 bits."""
    value = 2166136261
    for byte in data:
        value = (value ^ byte) * 16777619 & 0xffffffff
    return value


def open_page(chromium, page, fragment, folder, *arguments):
    profile = os.path.join(folder, "profile")
    shutil.rmtree(profile, ignore_errors=True)
    result = subprocess.run(
        [chromium, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync", "--window-size=1440,900",
         "--virtual-time-budget=10000", *arguments, "--dump-dom", f"file://{page}#{fragment}"],
        capture_output=True, text=True, timeout=300)
    assert result.returncode == 0, result.stderr
    return result.stdout


def points_of(dom):
    """Number of points in each chart."""
    groups = re.findall(r'<g[^>]* class="settings"[^>]*>(.*?)</g>', dom, re.S)
    return [len(re.findall("<circle", group)) for group in groups]


def requests_of_page(chromium, page, fragment, folder):
    """URLs that a page requests, by the browser's network log. The browser's own requests have no origin."""
    log = os.path.join(folder, "network.json")
    open_page(chromium, page, fragment, folder, f"--log-net-log={log}")
    with open(log) as file:
        events = json.load(file)["events"]
    parameters = [event.get("params", {}) for event in events]
    return {p["url"] for p in parameters if p.get("initiator", "not an origin") != "not an origin" and "url" in p}


def main(program, folder):
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if chromium is None:
        print("skipped: found no Chromium")
        sys.exit(77)
    folder = os.path.abspath(folder)
    rows = run(program, folder + "/run", write_scenes(folder, [2, 4]), "--threads", "2")
    report = folder + "/run/report.html"
    with open(report) as file:
        page = file.read()
    probed = folder + "/probed.html"
    with open(probed, "w") as file:
        file.write(page.replace("</body>", PROBE + "</body>"))

    for scene in "wall-2", "wall-4":
        dom = open_page(chromium, report, f"{scene}/default", folder)
        expected = sum(1 for row in rows if row["scene"] == scene)
        assert sum(points_of(dom)) == expected, f"{scene} has {points_of(dom)} points, expected {expected} in all"
        names = set(re.findall(r'<text class="name[^>]*>([^<]+)</text>', dom))
        labels = {setting["label"] for entry in json.load(open(folder + "/run/results.json"))["scenes"] if entry["name"] == scene
                  for setting in entry["settings"]}
        assert names == labels, f"points lack names: {labels - names}"

    for setting in "gouraud", "samples_4+half":
        dom = open_page(chromium, probed, f"wall-4/{setting}", folder)
        stem = folder + "/run/pictures/wall-4/"
        result, reference = read_png(f"{stem}{setting}.result.png")[2], read_png(stem + "reference_area.png")[2]
        [difference] = [name for name in os.listdir(stem) if name.startswith(setting + ".difference_area_x")]
        expected = [fnv(data) for data in (result, reference, read_png(stem + difference)[2])]
        probe = re.search(r'<pre id="probe">([\d ]+)</pre>', dom)
        assert probe, "the page did not run"
        assert [int(text) for text in probe[1].split()] == expected, f"{setting}: other pictures than in the files"

    control = folder + "/control.html"
    with open(control, "w") as file:
        file.write('<img src="http://127.0.0.1:9/control.png">')
    assert requests_of_page(chromium, control, "", folder) == {"http://127.0.0.1:9/control.png"}, "the log lacks requests"
    urls = requests_of_page(chromium, report, "wall-4/gouraud", folder)
    assert not urls, f"requests beyond the file: {urls}"

    without_scripts = re.sub(r"<script.*?</script>", "", page, flags=re.S)
    body = without_scripts[without_scripts.index("<tbody>"):without_scripts.index("</tbody>")]
    assert body.count("<tr ") == len(rows), "the table lacks rows without scripts"
    print(f"{len(rows)} points, pictures of links, no requests")


if __name__ == "__main__":
    main(*sys.argv[1:])
