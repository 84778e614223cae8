#include <gtest/gtest.h>

#include "support/support.h"

namespace limn::test {
namespace {

ProgramResult limn(const std::string& arguments) { return run_limn(LIMN_COMMAND, arguments); }

TEST(Usage, HelpAndVersionGoToStandardOutput)
{
    const ProgramResult version = limn("--version"), help = limn("--help");
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_EQ(version.output, "limn " LIMN_VERSION "\n");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.output.find("Usage: limn"), std::string::npos);
    EXPECT_EQ(version.errors + help.errors, "");
}

TEST(Usage, AnUnknownOptionIsAnsweredWithTheNearestRealOne)
{
    const ProgramResult result = limn("--vresion");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.output, "");
    EXPECT_EQ(result.errors, "limn: unknown option '--vresion'; did you mean '--version'?\n");
}

} // namespace
} // namespace limn::test
