"""Drives a headless Chromium through its debugging pipe (Chrome DevTools Protocol), with nothing but Python."""

import base64
import json
import os
import select
import subprocess
import tempfile
import time


class Browser:
    """One page of a Chromium; `errors` gathers what it complains of. To be used in a with statement."""

    def __init__(self, program):
        self._program, self.errors, self._count, self._rest, self._events = program, [], 0, b"", []

    def __enter__(self):
        self._profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        their_in, self._out = os.pipe()
        self._in, their_out = os.pipe()
        command = [self._program, "--headless", "--no-first-run", "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
                   f"--user-data-dir={self._profile.name}", "--remote-debugging-pipe", *(["--no-sandbox"] if os.geteuid() == 0 else []), "about:blank"]
        shell = ["sh", "-c", f'exec "$@" 3<&{their_in} 4>&{their_out}', "sh", *command]  # it reads descriptor 3 and writes 4
        self._process = subprocess.Popen(shell, pass_fds=(their_in, their_out), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(their_in), os.close(their_out)
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(f"{domain}.enable")
        return self

    def __exit__(self, *_):
        self._process.terminate()
        self._process.wait(30)
        os.close(self._in), os.close(self._out)
        self._profile.cleanup()

    def _read(self, deadline):
        while b"\0" not in self._rest:
            if not select.select([self._in], [], [], max(0, deadline - time.monotonic()))[0]:
                raise TimeoutError("Chromium does not answer")
            part = os.read(self._in, 1 << 20)
            if not part:
                raise ConnectionError("Chromium has ended")
            self._rest += part
        line, self._rest = self._rest.split(b"\0", 1)
        message = json.loads(line)
        if message.get("method") == "Runtime.exceptionThrown":
            self.errors.append(message["params"]["exceptionDetails"].get("exception", {}).get("description", "exception"))
        elif message.get("method") == "Runtime.consoleAPICalled" and message["params"]["type"] == "error":
            self.errors.append(str([a.get("value", a.get("description")) for a in message["params"]["args"]]))
        elif message.get("method") == "Log.entryAdded" and message["params"]["entry"]["level"] == "error":
            self.errors.append(message["params"]["entry"]["text"])
        return message

    def call(self, method, seconds=120, **parameters):
        """The result of a command; events that come before it are kept."""
        self._count += 1
        request = {"id": self._count, "method": method, "params": parameters}
        if hasattr(self, "_session"):
            request["sessionId"] = self._session
        os.write(self._out, json.dumps(request).encode() + b"\0")
        deadline = time.monotonic() + seconds
        while True:
            message = self._read(deadline)
            if message.get("id") == self._count:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}")
                return message["result"]
            self._events.append(message.get("method"))

    def open(self, url, width, height, seconds=120):
        """Loads a page in a window of so many pixels."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self._events.clear()
        self.call("Page.navigate", url=url)
        deadline = time.monotonic() + seconds
        while "Page.loadEventFired" not in self._events:
            self._events.append(self._read(deadline).get("method"))

    def evaluate(self, code):
        """The value of some JavaScript."""
        answer = self.call("Runtime.evaluate", expression=code, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"]["exception"].get("description"))
        return answer["result"].get("value")

    def wait_for(self, code, seconds=90):
        """Until some JavaScript is true."""
        deadline = time.monotonic() + seconds
        while not self.evaluate(code):
            if time.monotonic() > deadline:
                raise TimeoutError(code)
            time.sleep(0.3)

    def picture(self, selector=None):
        """PNG of what is seen; of an element alone by its selector."""
        clip = {}
        if selector:
            place = self.evaluate(f"(e => {{ e.scrollIntoView(); const r = e.getBoundingClientRect(); return [r.x + scrollX, r.y + scrollY, r.width, r.height]; }})"
                                  f"(document.querySelector({selector!r}))")
            clip = {"clip": dict(zip(("x", "y", "width", "height"), place), scale=1)}
        return base64.b64decode(self.call("Page.captureScreenshot", format="png", **clip)["data"])
