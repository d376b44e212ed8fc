// Mesa's driver, as the leak sanitizer sees it.
#pragma once

// For each window the driver keeps some bytes for ever, and it is unloaded with the window, so that nobody could tell
// whose they are. Keeps it loaded from here on, and its leaks are not told.
void keep_driver();
