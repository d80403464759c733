#include "service/auth/link_tickets.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(LinkTickets, AreForOneJobAndAMinute) {
  const LinkTickets tickets;
  const std::string ticket = tickets.Make("0123456789ab", "job", 1000);
  EXPECT_EQ(tickets.KeyOf(ticket, "job", 999), "0123456789ab");
  EXPECT_FALSE(tickets.KeyOf(ticket, "job", 1000));
  EXPECT_FALSE(tickets.KeyOf(ticket, "jab", 999));
}

TEST(LinkTickets, CannotBeChangedOrMadeElsewhere) {
  const LinkTickets tickets;
  const std::string ticket = tickets.Make("0123456789ab", "job", 1000);
  EXPECT_FALSE(LinkTickets().KeyOf(ticket, "job", 999)) << "another process has another secret";
  for (std::size_t i = 0; i < ticket.size(); ++i) {
    std::string other = ticket;
    other[i] = other[i] == '1' ? '2' : '1';
    EXPECT_FALSE(tickets.KeyOf(other, "job", 999)) << other;
  }
  for (const std::string& other :
       {std::string(), std::string("."), std::string(".."), std::string("a.b"), ticket + "0",
        ticket.substr(1), std::string(100'000, '.')}) {
    EXPECT_FALSE(tickets.KeyOf(other, "job", 999));
  }
}

}  // namespace
}  // namespace farhorizon
