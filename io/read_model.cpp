// SPDX-License-Identifier: Apache-2.0
#include "io/read_model.h"
