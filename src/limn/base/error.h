#pragma once

#include <stdexcept>

namespace limn {

/// Base of every error that Limn throws. The message is one line for a person: which file, which line or byte or
/// parameter, what was found, what was expected.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
    class Read;   ///< a file that cannot be read: missing, unknown, truncated, malformed
    class Write;  ///< a result that cannot be written: full disk, no permission
    class Input;  ///< a value a caller gave that is out of its range
    class Device; ///< a device (GPU, ray tracer) that cannot be used
};

class Error::Read : public Error {
public:
    using Error::Error;
};

class Error::Write : public Error {
public:
    using Error::Error;
};

class Error::Input : public Error {
public:
    using Error::Error;
};

class Error::Device : public Error {
public:
    using Error::Error;
};

} // namespace limn
