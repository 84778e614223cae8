#pragma once

#include <optional>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/gpu/context.h"

namespace limn::test {

/// A context whose driver's complaints are failures of the test. Skips the test where there is no driver at all.
class Gpu : public testing::Test {
protected:
    void SetUp() override
    {
        try {
            context.emplace();
        } catch (const Error::Device& error) {
            GTEST_SKIP() << error.what();
        }
        context->on_problem([](const std::string& message) { ADD_FAILURE() << "OpenGL: " << message; });
    }
    void TearDown() override
    {
        if (context) {
            EXPECT_NO_THROW(gpu::check_errors("testing"));
        }
    }
    std::optional<gpu::Context> context;
};

} // namespace limn::test
