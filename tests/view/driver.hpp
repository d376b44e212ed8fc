// Mesa's driver, with regard to the leak sanitizer.
#pragma once

// Keeps the driver loaded, so that its leaks can be suppressed: for each window it keeps some bytes forever, and it is
// unloaded with the window, after which leaks could not be attributed to it.
void keep_driver();
