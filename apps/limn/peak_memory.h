#pragma once

/// The most memory that this process has held at once, in bytes (Linux's VmHWM); 0 where the system does not say.
double peak_memory();
