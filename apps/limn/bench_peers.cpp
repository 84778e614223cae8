#include "bench_peers.h"

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "process_output.h"

std::optional<std::string> find_peer(const std::string& name)
{
    const std::filesystem::path beside = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "bench" / name;
    if (std::filesystem::exists(beside))
        return fmt::format("'{}'", beside.string());
    if (std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0)
        return name;
    return std::nullopt;
}

nlohmann::json result_of_peer(const std::string& command, const std::string& arguments)
{
    const std::string whole = command + " " + arguments;
    nlohmann::json result = nlohmann::json::parse(output_of(whole), nullptr, false);
    if (!result.is_object())
        throw limn::Error::Device("a program that is measured beside limn failed: " + whole);
    return result;
}
