// Stub.
#pragma once
