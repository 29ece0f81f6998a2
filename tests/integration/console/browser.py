"""A real browser on the console's page: Debian's Chromium, headless."""
import base64
import shutil
import tempfile

SKIP = 77  # exit status of a test that the machine cannot run


def there():
    """Whether this machine has what it takes."""
    try:
        import selenium.webdriver  # noqa: F401
    except ImportError:
        return False
    return bool(shutil.which("chromium") and shutil.which("chromedriver"))


class Browser:
    def __init__(self, width=1400, height=900, dark=False, scale=1.0):
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        self.profile = tempfile.mkdtemp(prefix="browser-")
        for flag in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu", "--no-first-run",
                     "--disable-background-networking", "--disable-component-update", f"--window-size={width},{height}",
                     f"--force-device-scale-factor={scale}", f"--user-data-dir={self.profile}", "--hide-scrollbars"):
            options.add_argument(flag)
        if dark:
            options.add_argument("--blink-settings=preferredColorScheme=0")
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        self.driver.set_script_timeout(30)

    def open(self, url):
        self.driver.get(url)

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def text(self, element):
        return self.js("return document.getElementById(arguments[0]).textContent", element)

    def click(self, element):
        self.js("document.getElementById(arguments[0]).click()", element)

    def complaints(self):
        """What the browser says in its console that is an error."""
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]

    def screenshot(self, path, scale=0.66):
        """Smaller than it is shown, for docs."""
        clip = {"x": 0, "y": 0, "width": self.js("return innerWidth"), "height": self.js("return innerHeight"), "scale": scale}
        taken = self.driver.execute_cdp_cmd("Page.captureScreenshot", {"format": "png", "clip": clip})
        with open(path, "wb") as file:
            file.write(base64.b64decode(taken["data"]))

    def close(self):
        self.driver.quit()
        shutil.rmtree(self.profile, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
