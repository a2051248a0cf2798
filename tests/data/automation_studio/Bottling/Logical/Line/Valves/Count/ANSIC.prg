<?xml version="1.0" encoding="utf-8"?>
<?AutomationStudio Version=4.12.2.93 SP?>
<Program SubType="ANSIC" xmlns="http://br-automation.co.at/AS/Program">
  <Files>
    <File>Main.c</File>
    <File Private="true">Count.var</File>
  </Files>
</Program>