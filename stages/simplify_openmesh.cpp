// SPDX-License-Identifier: Apache-2.0
#include "stages/simplify.h"
