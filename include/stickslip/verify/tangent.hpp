// SPDX-License-Identifier: BSL-1.0
#pragma once

/// Checks of tangents and of objectivity for user-defined policies. They return relative errors and need no test
/// framework: verify::material_tangent, element_tangent, contact_tangent, tool_derivatives, system_tangent.

#include <stickslip/verify/contact.hpp>
#include <stickslip/verify/element.hpp>
#include <stickslip/verify/material.hpp>
#include <stickslip/verify/system.hpp>
#include <stickslip/verify/tool.hpp>
